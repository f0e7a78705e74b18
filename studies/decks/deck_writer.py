"""Small LS-DYNA decks of our own, for tests: meshes of bars, blocks and balls as keyword cards."""

import numpy as np


class Deck:
    """Cards of a deck; nodes and elements are numbered as they come."""

    def __init__(self, title="a deck"):
        self.nodes, self.solids, self.cards = [], [], []
        self.title = title

    def add(self, *lines):
        self.cards += lines

    def grid(self, part, places, held=None, shared=None):
        """Hexahedra between places of shape (nx, ny, nz, 3); held: TC codes of the nodes by (i, j, k), or None; shared:
        nodes by place, of grids that meet at common nodes.

        Returns the node numbers, an array of shape (nx, ny, nz)."""
        shape = places.shape[:3]
        numbers = np.zeros(shape, dtype=int)
        for index in np.ndindex(shape):
            place = tuple(np.round(places[index], 9) + 0.0)
            if shared is not None and place in shared:
                numbers[index] = shared[place]
                continue
            numbers[index] = len(self.nodes) + 1
            self.nodes.append((numbers[index], *places[index], held(*index) if held else 0))
            if shared is not None:
                shared[place] = numbers[index]
        for i, j, k in np.ndindex(*(n - 1 for n in shape)):
            corners = [numbers[i + a, j + b, k + c] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            self.solids.append((len(self.solids) + 1, part, *corners))
        return numbers

    def cylinder(self, part, radius, ends, core, ring, layers):
        """A cylinder along z from ends[0] to ends[1]: a square core of core x core elements across, four sectors of
        ring elements around it."""
        heights = np.linspace(*ends, layers + 1)
        half = 0.5 * radius  # of the core's side
        edge = np.linspace(-1, 1, core + 1)

        def stand(flat):
            """Places of shape (nx, ny, 2) at all heights."""
            flat = np.repeat(flat[:, :, None], len(heights), axis=2)
            return np.concatenate([flat, np.broadcast_to(heights[:, None], (*flat.shape[:3], 1))], axis=3)

        square = half * np.stack(np.meshgrid(edge, edge, indexing="ij"), axis=-1)
        square *= 1 - 0.15 * (np.hypot(*np.moveaxis(square, -1, 0)) / (half * np.sqrt(2)))[..., None] ** 2
        shared = {}
        self.grid(part, stand(square), shared=shared)
        angle = np.pi / 4 * edge
        outer = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        share = np.linspace(0, 1, ring + 1)[:, None, None]
        sector = (1 - share) * square[-1] + share * outer
        for quarter in range(4):
            c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
            turned = np.stack([c * sector[..., 0] - s * sector[..., 1], s * sector[..., 0] + c * sector[..., 1]], -1)
            self.grid(part, stand(turned), shared=shared)

    def block(self, part, low, high, divisions, held=None):
        """A block of equal hexahedra from one corner to the other."""
        lines = [np.linspace(low[a], high[a], divisions[a] + 1) for a in range(3)]
        places = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
        return self.grid(part, places, held)

    def part(self, number, title, material, hourglass=0):
        self.add("*PART", title, card(number, 1, material, 0, hourglass))

    def text(self):
        lines = ["*KEYWORD", "*TITLE", self.title, "*NODE"]
        lines += [f"{n:8d}{x:16.9g}{y:16.9g}{z:16.9g}{code:8d}{0:8d}" for n, x, y, z, code in self.nodes]
        lines += ["*ELEMENT_SOLID"]
        lines += ["".join(f"{number:8d}" for number in solid) for solid in self.solids]
        lines += ["*SECTION_SOLID", card(1, 1), *self.cards, "*END"]
        return "\n".join(lines) + "\n"


def card(*fields):
    """Fields of ten columns."""
    return "".join(f"{field:>10d}" if isinstance(field, (int, np.integer)) else f"{field:>10.4g}" for field in fields)


def grow(first, total, count):
    """count + 1 places from 0 to total, the first step `first`, each longer than the one before by one factor."""
    low, high = 1.0 + 1e-9, 4.0
    for _ in range(200):
        middle = (low + high) / 2
        if first * (middle**count - 1) / (middle - 1) > total:
            high = middle
        else:
            low = middle
    steps = first * low ** np.arange(count)
    return np.concatenate([[0], np.cumsum(steps)]) * total / steps.sum()


def quarter_ball(radius, fine, divisions, up):
    """Places of a ball's quarter x, y >= 0, graded towards its pole at the origin; up: it lies above that, else below.

    A cube is mapped onto the ball such that each of its sides becomes a sixth of the sphere."""
    across = grow(fine, 1.0, divisions[0])
    along = -1 + grow(fine, 2.0, divisions[1])
    x, y, z = np.meshgrid(across, across, along, indexing="ij")
    places = np.stack(
        [
            x * np.sqrt(1 - y**2 / 2 - z**2 / 2 + y**2 * z**2 / 3),
            y * np.sqrt(1 - x**2 / 2 - z**2 / 2 + x**2 * z**2 / 3),
            z * np.sqrt(1 - x**2 / 2 - y**2 / 2 + x**2 * y**2 / 3),
        ],
        axis=-1,
    )
    places = radius * places
    places[..., 2] += radius
    if not up:
        places[..., 2] *= -1
        places = places[:, :, ::-1]
    return places
