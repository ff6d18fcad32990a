"""Q-learning over the productions of a grammar."""
