"""Pick and place with a mobile manipulator: a domain for grammarbt."""
