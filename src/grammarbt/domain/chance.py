"""Chance as a function of what is decided, not a stream: trees that have done the same so far meet the same luck."""

from __future__ import annotations

__all__ = ["mix", "uniform"]

_SIXTY_FOUR_BITS = 2**64 - 1


def mix(number: int) -> int:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + 1) * 0x9E3779B97F4A7C15 & _SIXTY_FOUR_BITS
    number = (number ^ number >> 30) * 0xBF58476D1CE4E5B9 & _SIXTY_FOUR_BITS
    number = (number ^ number >> 27) * 0x94D049BB133111EB & _SIXTY_FOUR_BITS
    return number ^ number >> 31


def uniform(key: int) -> float:
    """A number from 0 to below 1, with 53 random bits, that the key alone decides."""
    return float(mix(key) >> 11) * 2.0**-53
