"""Marine target search and response: a domain for grammarbt."""
