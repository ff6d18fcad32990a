"""What runs amounted to: histories, statistics, tables and pictures."""
