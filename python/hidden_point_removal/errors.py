"""Refusals."""

from ._native import HprError


def refusal(code, message):
    """An `HprError` with a code."""
    error = HprError(message)
    error.code = code
    return error
