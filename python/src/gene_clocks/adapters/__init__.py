"""Adapters: Gene Clocks inside of other people's NEATs, without importing them."""
