"""Simulations side by side on dask.distributed."""
