// The contact solution at one instant, put together from the tables of the page's data.
import { columns, numbers } from "./blocks.js";

const loaded = new Map();

/** All of a contact, unpacked once: tables with a `from` of each patch row. */
export function solution(contact) {
    if (!loaded.has(contact)) loaded.set(contact, load(contact));
    return loaded.get(contact);
}

async function load(contact) {
    const values = await Promise.all(contact.patches.map((one) => numbers(one.values)));
    const patches = Object.fromEntries(contact.patches.map(({ name }, i) => [name, values[i]]));
    const [nodes, facets, cuts] = await Promise.all([contact.nodes, contact.facets, contact.cuts].map(columns));
    const instants = contact.drawn.map((row) => ({ time: patches.time[row], row }));
    return {
        contact,
        patches,
        nodes,
        facets,
        cuts,
        instants,
        rows: { nodes: ranges(nodes.row), facets: ranges(facets.row), cuts: ranges(cuts.row) },
        most: extremes(nodes, cuts),
    };
}

/** Of each patch row the stretch [from, to) of a table that is of it. */
function ranges(row) {
    const found = new Map();
    for (let i = 0; i < row.length; ++i) {
        if (!found.has(row[i])) found.set(row[i], [i, i]);
        found.get(row[i])[1] = i + 1;
    }
    return found;
}

/** Largest values at all instants: one scale for all of them; `below`: how far shear along cuts is below zero. */
function extremes(nodes, cuts) {
    const most = { pressure: 0, shear: 0, slip: 0, along: 0, across: 0, below: 0 };
    for (const name of ["shear_along", "shear_across"])
        for (const value of cuts[name]) if (-value > most.below) most.below = -value;
    for (let i = 0; i < nodes.row.length; ++i) {
        most.along = Math.max(most.along, Math.abs(nodes.along[i]));
        most.across = Math.max(most.across, Math.abs(nodes.across[i]));
        if (nodes.touching[i] < 0.5) continue;
        most.pressure = Math.max(most.pressure, nodes.pressure[i]);
        most.shear = Math.max(most.shear, Math.hypot(nodes.shear_along[i], nodes.shear_across[i]));
        const slip = Math.hypot(nodes.micro_slip_along[i], nodes.micro_slip_across[i]);
        if (Number.isFinite(slip)) most.slip = Math.max(most.slip, slip);
    }
    return most;
}

/** Numbers of the patches at any instant, the one with the largest force first. */
export function patchNumbers({ patches, rows }) {
    const force = new Map();
    for (const row of rows.nodes.keys()) {
        const number = patches.patch[row];
        force.set(number, Math.max(force.get(number) ?? 0, patches.normal_force[row]));
    }
    return [...force.keys()].sort((a, b) => force.get(b) - force.get(a));
}

/** Position of the instant nearest to a time. */
export function nearest(instants, time) {
    let best = 0;
    instants.forEach((one, i) => {
        if (Math.abs(one.time - time) < Math.abs(instants[best].time - time)) best = i;
    });
    return best;
}

/** The patch of that number at an instant, null where it is not there; number 0: the one with the largest force. */
export function patchAt(whole, instant, number) {
    const { patches, rows } = whole;
    let row = null;
    for (let i = whole.instants[instant].row + 1; i < patches.patch.length && patches.patch[i] > 0; ++i) {
        if (!rows.nodes.has(i)) continue;
        if (
            number > 0
                ? patches.patch[i] === number
                : row === null || patches.normal_force[i] > patches.normal_force[row]
        )
            row = i;
    }
    if (row === null) return null;
    const [from, to] = rows.nodes.get(row);
    const part = (name) => whole.nodes[name].subarray(from, to);
    const names = Object.keys(whole.nodes);
    const nodes = Object.fromEntries(names.map((name) => [name, part(name)]));
    const [first, last] = rows.facets.get(row) ?? [0, 0];
    const facets = [];
    for (let i = first; i < last; ++i) facets.push([0, 1, 2, 3].map((c) => whole.facets[`corner_${c}`][i] - from));
    const figures = Object.fromEntries(Object.keys(patches).map((name) => [name, patches[name][row]]));
    return { figures, nodes, facets, count: to - from, cut: cutAlong(whole, row) };
}

/** The cut along the rolling direction through the patch's centre. */
function cutAlong({ cuts, rows }, row) {
    const [from, to] = rows.cuts.get(row) ?? [0, 0];
    const places = [];
    for (let i = from; i < to; ++i) if (cuts.cut[i] < 0.5) places.push(i);
    const names = ["distance", "pressure", "traction_bound", "shear_along", "shear_across"];
    return Object.fromEntries(names.map((name) => [name, places.map((i) => cuts[name][i])]));
}
