"""Ways to damage a file, by a seeded chance: the same number makes the same damage."""

import random
import re
import struct

SIGNATURES = re.compile(
    rb"TREE|HEAP|GCOL|SNOD|OHDR|OCHK|EAHD|EAIB|EASB|EADB|FAHD|FADB|BTHD|BTLF|BTIN|FRHP|FHDB|FHIB|RWsealed"
)
NUMBERS = [
    0, 1, 2, 3, 7, 8, 16, 127, 128, 255, 256, 4095, 4096, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**40,
    2**62, 2**63 - 1, 2**63, 2**64 - 1,
]


class Damage:
    def __init__(self, number):
        self.chance = random.Random(number)
        self.done = []

    def place(self, data):
        """Mostly in what tells the file's structure."""
        chance, kind = self.chance, self.chance.random()
        if kind < 0.15:
            return chance.randrange(min(1024, len(data)))
        if kind < 0.7:
            found = [match.start() for match in SIGNATURES.finditer(data)]
            if found:
                return min(
                    len(data) - 1,
                    chance.choice(found) + (chance.randrange(24) if chance.random() < 0.5 else chance.randrange(512)),
                )
        return chance.randrange(len(data))

    def flip(self, data):
        at = self.place(data)
        data[at] ^= 1 << self.chance.randrange(8)
        return f"bit of byte {at}"

    def byte(self, data):
        at = self.place(data)
        data[at] = self.chance.choice([0, 1, 2, 4, 8, 127, 128, 254, 255, self.chance.randrange(256)])
        return f"byte {at}"

    def word(self, data):
        at, size = self.place(data), self.chance.choice([2, 4, 8])
        number = self.chance.choice([*NUMBERS, len(data), len(data) - 1, self.chance.randrange(2**64)]) % 2 ** (
            8 * size
        )
        word = struct.pack("<Q", number)[:size]
        data[at : at + size] = word[: max(0, min(size, len(data) - at))]
        return f"{size} bytes at {at}: {number}"

    def shift(self, data):
        """A length or an address that is a little off."""
        at = min(self.place(data), len(data) - 8)
        number = struct.unpack_from("<Q", data, at)[0]
        struct.pack_into("<Q", data, at, (number + self.chance.choice([-4096, -8, -1, 1, 8, 24, 4096])) % 2**64)
        return f"number at {at}"

    def cut(self, data):
        length = self.chance.choice(
            [
                self.chance.randrange(len(data)),
                len(data) - 1 - self.chance.randrange(min(64, len(data))),
                self.chance.randrange(min(2048, len(data))),
            ]
        )
        del data[length:]
        return f"cut to {length}"

    def fill(self, data):
        at, length = self.place(data), self.chance.choice([4, 16, 64, 512, 4096, 16384])
        if self.chance.random() < 0.5:
            at -= at % 512
        length = min(length, len(data) - at)
        data[at : at + length] = bytes([self.chance.choice([0, 0, 255, 65])]) * length
        return f"{length} bytes filled at {at}"

    def copy(self, data):
        length = self.chance.choice([8, 64, 512, 4096])
        at, source = self.place(data), self.place(data)
        if self.chance.random() < 0.5:
            at, source = at - at % 512, source - source % 512
        piece = data[source : source + length][: len(data) - at]
        data[at : at + len(piece)] = piece
        return f"{length} bytes from {source} to {at}"

    def swap(self, data):
        length = self.chance.choice([8, 64, 512, 4096])
        a, b = sorted((self.place(data), self.place(data)))
        length = min(length, b - a, len(data) - b)
        data[a : a + length], data[b : b + length] = data[b : b + length], data[a : a + length]
        return f"{length} bytes of {a} and {b} swapped"

    def insert(self, data):
        at, length = self.place(data), self.chance.choice([1, 8, 512])
        if self.chance.random() < 0.5:
            data[at:at] = bytes(length)
            return f"{length} bytes put in at {at}"
        del data[at : at + length]
        return f"{length} bytes taken out at {at}"

    def add(self, data):
        data += bytes(self.chance.randrange(256) for _ in range(self.chance.choice([1, 40, 4096])))
        return "bytes added at the end"

    def apply(self, sound):
        """Damaged bytes; those of the sound file where the damage happens to change nothing."""
        data = bytearray(sound)
        kinds = (
            [self.flip] * 5
            + [self.byte] * 3
            + [self.word] * 5
            + [self.shift] * 2
            + [self.cut, self.fill, self.fill, self.copy, self.swap, self.insert, self.add]
        )
        for _ in range(self.chance.choice([1, 1, 1, 1, 2, 4])):
            if len(data) > 16:
                self.done.append(self.chance.choice(kinds)(data))
        return bytes(data)
