"""Composing trees from sub-trees."""
