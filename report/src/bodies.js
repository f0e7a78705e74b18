// Bodies of a result at an instant: where their nodes are, and the value that colours them.
import { all, numbers } from "./blocks.js";

const AXES = ["x", "y", "z"];
const STRESSES = ["xx", "yy", "zz", "xy", "yz", "zx"];
// A body that turns or travels farther keeps its rigid motion as it is when its deformation is drawn larger (as
// scripts/picture does): rad, and a share of its size.
const TURNS = 0.01;
const TRAVELS = 0.1;
const SAMPLE = 200000; // values at most from which the scale of colours is found

const size = ([x, y, z]) => Math.hypot(x, y, z);

function mises([xx, yy, zz, xy, yz, zx]) {
    const normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2;
    return Math.sqrt(0.5 * normal + 3 * (xy * xy + yz * yz + zx * zx));
}

/** The quantities that a field can be seen by: {name, text, field, of(components)}. */
function quantitiesOf(field, components) {
    const text = field.replaceAll("_", " ");
    if (components === 1) return [{ name: field, text, field, of: ([value]) => value }];
    const parts = components === 3 ? AXES : STRESSES;
    const single = parts.map((part, c) => ({
        name: `${field}:${part}`,
        text: `${text} ${part}`,
        field,
        of: (all_) => all_[c],
    }));
    if (components === 3) return [{ name: `${field}:size`, text: `${text}, size`, field, of: size }, ...single];
    return [
        { name: "mises_of_stress", text: "von Mises stress", field, of: mises },
        { name: "pressure", text: "mean pressure", field, of: ([xx, yy, zz]) => -(xx + yy + zz) / 3 },
        ...single,
    ];
}

/** All quantities of the bodies, each once. */
export function quantities(bodies) {
    const found = new Map();
    for (const { outputs } of bodies) {
        if (outputs.length === 0) continue;
        const of = (field, references) => {
            for (const one of quantitiesOf(field, references.length))
                if (!found.has(one.name)) found.set(one.name, one);
        };
        for (const [field, references] of Object.entries(outputs[0].fields)) of(field, references);
        if (outputs[0].rest) of("displacement", outputs[0].rest);
    }
    const list = [...found.values()];
    // Stress first, as people look at it first.
    return [
        ...list.filter(({ field }) => field !== "displacement" && field !== "velocity"),
        ...list.filter(({ field }) => field === "displacement" || field === "velocity"),
    ];
}

const moved = (turn, shift, [x, y, z]) =>
    [0, 1, 2].map((r) => turn[3 * r] * x + turn[3 * r + 1] * y + turn[3 * r + 2] * z + shift[r]);

/** A body that is unpacked as it is asked for. */
export class Body {
    constructor(data) {
        this.data = data;
        this.name = data.name;
    }

    async load() {
        if (this.corners) return;
        const [coordinates, corners] = await all([this.data.coordinates, this.data.corners]);
        const { nodes: n, faces: f } = this.data;
        this.nodes = Array.from({ length: n }, (_, i) => [coordinates[i], coordinates[n + i], coordinates[2 * n + i]]);
        this.corners = Array.from({ length: f }, (_, i) => [0, 1, 2, 3].map((c) => corners[c * f + i]));
        this.travels = this.data.outputs.some((output) => this.#travelsAt(output));
    }

    #travelsAt({ turn, shift }) {
        if (!turn) return false;
        const low = [0, 1, 2].map((a) => this.nodes.reduce((least, node) => Math.min(least, node[a]), Infinity));
        const high = [0, 1, 2].map((a) => this.nodes.reduce((most, node) => Math.max(most, node[a]), -Infinity));
        const middle = low.map((value, a) => (value + high[a]) / 2);
        const way = size(moved(turn, shift, middle).map((value, a) => value - middle[a]));
        const angle = Math.acos(Math.min(1, Math.max(-1, (turn[0] + turn[4] + turn[8] - 1) / 2)));
        return angle > TURNS || way > TRAVELS * size(high.map((value, a) => value - low[a]));
    }

    /** Position of the output nearest to a time. */
    outputAt(time) {
        let best = 0;
        this.data.outputs.forEach((one, i) => {
            if (Math.abs(one.time - time) < Math.abs(this.data.outputs[best].time - time)) best = i;
        });
        return best;
    }

    /** Places of the nodes, the deformation drawn `scale` times. */
    async places(output, scale) {
        const { turn, shift, rest } = this.data.outputs[output];
        if (!turn) return this.nodes;
        const left = await all(rest);
        return this.nodes.map((node, i) => {
            const rigid = moved(turn, shift, node);
            if (!left.every((part) => Number.isFinite(part[i]))) return rigid; // not known, where a run broke down
            if (scale === 1 || this.travels) return rigid.map((value, a) => value + scale * left[a][i]);
            return node.map((value, a) => value + scale * (rigid[a] + left[a][i] - value));
        });
    }

    /** {values, ofNodes}: of each node or face; null where the body has no such field. */
    async values(output, { field, of }) {
        const data = this.data.outputs[output];
        if (field === "displacement") {
            if (!data.turn) return null;
            const places = await this.places(output, 1);
            return { values: places.map((place, i) => of(place.map((v, a) => v - this.nodes[i][a]))), ofNodes: true };
        }
        if (!data.fields[field]) return null;
        const parts = await Promise.all(data.fields[field].map(numbers));
        const values = Array.from(parts[0], (_, i) => of(parts.map((part) => part[i])));
        return { values, ofNodes: field === "velocity" || field === "acceleration" };
    }

    /** Values at all outputs, ascending; of many a sample. */
    async sorted(quantity) {
        const values = [];
        const outputs = this.data.outputs.length;
        for (let output = 0; output < outputs; ++output) {
            const found = (await this.values(output, quantity))?.values ?? [];
            const stride = Math.max(1, Math.floor((found.length * outputs) / SAMPLE));
            let low = Infinity;
            let high = -Infinity;
            found.forEach((value, i) => {
                if (value < low) low = value;
                if (value > high) high = value;
                if (i % stride === 0 && Number.isFinite(value)) values.push(value);
            });
            if (low <= high) values.push(low, high);
        }
        return Float64Array.from(values).sort();
    }
}
