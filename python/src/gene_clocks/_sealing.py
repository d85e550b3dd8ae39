"""Frames under a key; without libsodium, a clear error."""

from __future__ import annotations

from typing import Any

from gene_clocks import _core
from gene_clocks._core import GeneClock
from gene_clocks._messages import _STANDARD, WireLimits

_MISSING = ("this gene_clocks was built without libsodium, so that frames can neither be sealed nor opened: "
            "install libsodium's headers (Debian: libsodium-dev) and build it again. "
            "gene_clocks.has_authentication tells")


class Sealer:
    """Seals frames under the fleet's key of 32 bytes. numbers is a GeneClock of its own, stored and
    restarted as that of genes is; it is handed over, and mints nothing more itself."""

    __slots__ = ("_sealer",)

    def __init__(self, key: bytes | bytearray | memoryview, numbers: GeneClock) -> None:
        if not _core.has_authentication:
            raise RuntimeError(_MISSING)
        self._sealer: Any = _core.Sealer(key, numbers)

    def seal(self, frame: bytes | bytearray | memoryview) -> bytes | None:
        """The sealed frame; None where no number is left."""
        sealed: bytes | None = self._sealer.seal(frame)
        return sealed

    def durable_needed(self) -> int:
        """Must be on stable storage before what seal() returned last may leave."""
        return int(self._sealer.durable_needed())


class Opener:
    """Opens what Sealer sealed, each frame once. windows are those of an earlier life; without them frames
    of old are opened once more."""

    __slots__ = ("_opener",)

    def __init__(self, key: bytes | bytearray | memoryview, limits: WireLimits = _STANDARD, *,
                 senders_max: int = 1024, windows: dict[int, tuple[int, int]] | None = None) -> None:
        if not _core.has_authentication:
            raise RuntimeError(_MISSING)
        self._opener: Any = _core.Opener(key, limits, senders_max=senders_max, windows=windows or {})

    def open(self, sealed: bytes | bytearray | memoryview) -> bytes:
        """The frame in it, for decode(); SealError where it is refused."""
        return bytes(self._opener.open(sealed))

    def windows(self) -> dict[int, tuple[int, int]]:
        """By sender: the largest number opened, and a bit for each of the 64 numbers down from it."""
        return dict(self._opener.windows())

    def counts(self) -> dict[str, int]:
        """Frames opened, and refused by reason."""
        return dict(self._opener.counts())
