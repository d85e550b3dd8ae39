"""Fragments, split and put together as docs/wire-format.md says, from the document alone. Standard library
only."""

from decoder import Bytes, Refused

MARKER = 64


def varint(value):
    out = bytearray()
    while value >= 0x80:
        out.append(0x80 | value & 0x7F)
        value >>= 7
    return bytes([*out, value])


def split(message, sender, number, fragment_bytes):
    """The fragments of a message, or None where it takes too many."""
    if len(message) <= fragment_bytes:
        return [message]
    header = bytes([MARKER]) + varint(sender) + bytes([number])
    room = fragment_bytes - len(header) - 2
    if room < 1 or -(-len(message) // room) > 256:
        return None
    size = -(-len(message) // -(-len(message) // room))
    pieces = [message[at : at + size] for at in range(0, len(message), size)]
    return [header + bytes([len(pieces) - 1, i]) + piece for i, piece in enumerate(pieces)]


class Message:
    def __init__(self, number, last):
        self.number, self.last, self.pieces, self.touched = number, last, {}, 0

    @property
    def is_whole(self):
        return len(self.pieces) == self.last + 1

    def piece_bytes(self):
        return next((len(piece) for i, piece in self.pieces.items() if i != self.last), None)

    def goes_with(self, last, index, piece):
        others, end = self.piece_bytes(), self.pieces.get(self.last)
        if last != self.last or self.pieces.get(index, piece) != piece:
            return False
        if index == last:
            return others is None or len(piece) <= others
        return others in (None, len(piece)) and (end is None or len(end) <= len(piece))


class Assembler:
    def __init__(self, messages, message_bytes):
        self.room, self.message_bytes = messages, message_bytes
        self.messages, self.time = {}, 0  # by sender

    def take(self, data):
        """The outcome, and the message where it completes."""
        if data and data[0] != MARKER:
            return ("too_long", None) if len(data) > self.message_bytes else ("completes", data)
        try:
            source = Bytes(data)
            source.byte()
            sender, number, last, index = source.varint(32), source.byte(), source.byte(), source.byte()
        except Refused:
            return "malformed", None
        piece = data[source.at :]
        if sender == 0 or last == 0 or index > last or not piece:
            return "malformed", None
        self.time += 1
        message = self.messages.get(sender)
        if message and 1 <= (message.number - number) % 256 <= 8:
            return "late", None
        if message is None or message.number != number or not message.goes_with(last, index, piece):
            message = self.begin(sender, number, last)
        message.touched = self.time
        if index in message.pieces:
            return "repeated", None
        message.pieces[index] = piece
        end, others = len(message.pieces.get(last, b"?")), message.piece_bytes() or 0
        if others * last + end > self.message_bytes:
            del self.messages[sender]
            return "too_long", None
        if not message.is_whole:
            return "kept", None
        return "completes", b"".join(message.pieces[i] for i in range(last + 1))

    def begin(self, sender, number, last):
        if sender not in self.messages and len(self.messages) == self.room:
            spared = min(self.messages, key=lambda one: (not self.messages[one].is_whole,
                                                         self.messages[one].touched))
            del self.messages[spared]
        self.messages[sender] = Message(number, last)
        return self.messages[sender]
