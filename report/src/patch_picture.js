// One contact patch as a plot: coloured facets, arrows, the state of each node under the pointer.
import { named, ramp, rampScale } from "./colours.js";
import { layout } from "./plot.js";
import { digits } from "./units.js";

const MM = 1e3;
const MPA = 1e-6;
const PIXELS = 900; // of the picture's longer side
const MOST_PIECES = 20000; // that all facets together are drawn in
const ARROWS = 24; // across the picture at most

/** What colours the patch: of a node, in units that people read. */
export const COLOURS = {
    pressure: { text: "pressure, MPa", of: (n, i) => MPA * n.pressure[i], most: ({ pressure }) => MPA * pressure },
    shear: {
        text: "shear stress, MPa",
        of: (n, i) => (n.touching[i] > 0.5 ? MPA * Math.hypot(n.shear_along[i], n.shear_across[i]) : 0),
        most: ({ shear }) => MPA * shear,
    },
    slip: {
        text: "micro-slip, m/s",
        of: (n, i) => Math.hypot(n.micro_slip_along[i], n.micro_slip_across[i]),
        most: ({ slip }) => slip,
    },
};
const STATES = "state"; // stick and slip

/** What the arrows show. */
export const ARROWS_OF = {
    shear: {
        along: "shear_along",
        across: "shear_across",
        most: ({ shear }) => shear,
        factor: MPA,
        unit: "MPa",
        text: "shear",
    },
    slip: {
        along: "micro_slip_along",
        across: "micro_slip_across",
        most: ({ slip }) => slip,
        factor: 1,
        unit: "m/s",
        text: "micro-slip",
    },
};

/** How it is said whether a node slips. */
export const CRITERIA = {
    slips_by_solver: "as the run found it",
    slips_by_force: "by force (eq. 3.6)",
    slips_by_velocity: "by micro-slip (eq. 3.6)",
};

/** Half the width and height of the window, mm: the same at all instants. */
const windowOf = ({ along, across }) => [1.08 * MM * along, 1.08 * MM * across];

/** Place of the point (s, t), 0 to 1, of a facet, and its shares of the corners. */
const shares = (s, t) => [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t];

/** Colours of the facets on a canvas, as an address that Plotly takes. */
function canvasOf(patch, most, colourBy, criterion) {
    const [halfX, halfY] = windowOf(most);
    const scale = PIXELS / (2 * Math.max(halfX, halfY));
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.round(2 * halfX * scale));
    canvas.height = Math.max(1, Math.round(2 * halfY * scale));
    const context = canvas.getContext("2d");
    const { nodes } = patch;
    const x = (i) => (MM * nodes.along[i] + halfX) * scale;
    const y = (i) => (halfY - MM * nodes.across[i]) * scale;
    const quad = (facet, s, t, ds, dt, colour) => {
        context.fillStyle = context.strokeStyle = colour;
        context.beginPath();
        for (const [a, b] of [
            [0, 0],
            [1, 0],
            [1, 1],
            [0, 1],
        ]) {
            const share = shares(s + a * ds, t + b * dt);
            context.lineTo(
                share.reduce((sum, part, c) => sum + part * x(facet[c]), 0),
                share.reduce((sum, part, c) => sum + part * y(facet[c]), 0),
            );
        }
        context.closePath();
        context.fill();
        context.stroke(); // closes the seam to the neighbour
    };
    const pieces = Math.max(3, Math.min(16, Math.round(Math.sqrt(MOST_PIECES / patch.facets.length))));
    for (const facet of patch.facets)
        if (colourBy === STATES) drawStates(quad, facet, nodes, criterion);
        else drawValues(quad, facet, nodes, COLOURS[colourBy], COLOURS[colourBy].most(most), pieces);
    return canvas.toDataURL();
}

/** The quarter of the facet beside each touching node in the colour of its state. */
function drawStates(quad, facet, nodes, criterion) {
    const colour = { stick: named("--stick"), slip: named("--slip") };
    const corner = [
        [0, 0],
        [0.5, 0],
        [0.5, 0.5],
        [0, 0.5],
    ];
    facet.forEach((node, c) => {
        if (nodes.touching[node] < 0.5) return;
        quad(facet, ...corner[c], 0.5, 0.5, colour[nodes[criterion][node] > 0.5 ? "slip" : "stick"]);
    });
}

/**
 * Values of the corners between them (bilinear), in small pieces of one colour each. The patch ends half-way between
 * nodes that touch and nodes that do not.
 */
function drawValues(quad, facet, nodes, { of }, most, pieces) {
    const touches = facet.map((node) => (nodes.touching[node] > 0.5 ? 1 : 0));
    const values = facet.map((node, c) => (touches[c] ? of(nodes, node) : 0)).map((v) => (Number.isFinite(v) ? v : 0));
    for (let a = 0; a < pieces; ++a)
        for (let b = 0; b < pieces; ++b) {
            const share = shares((a + 0.5) / pieces, (b + 0.5) / pieces);
            if (share.reduce((sum, part, c) => sum + part * touches[c], 0) < 0.5) continue;
            const value = share.reduce((sum, part, c) => sum + part * values[c], 0);
            quad(facet, a / pieces, b / pieces, 1 / pieces, 1 / pieces, `rgb(${ramp(value / most).join(",")})`);
        }
}

/** Outlines of the facets: one curve with gaps. */
function meshTrace({ facets, nodes }) {
    const x = [];
    const y = [];
    for (const facet of facets) {
        for (const c of [0, 1, 2, 3, 0]) {
            x.push(MM * nodes.along[facet[c]]);
            y.push(MM * nodes.across[facet[c]]);
        }
        x.push(null);
        y.push(null);
    }
    return { x, y, mode: "lines", hoverinfo: "skip", line: { width: 0.5, color: named("--faint") }, opacity: 0.5 };
}

/** Nodes that carry an arrow: one in each square of a grid that is so coarse that arrows do not overlap. */
function nodesWithArrows({ nodes, count }, most) {
    const size = (2 * MM * Math.max(most.along, most.across)) / ARROWS;
    const taken = new Set();
    const chosen = [];
    for (let i = 0; i < count; ++i) {
        if (nodes.touching[i] < 0.5) continue;
        const square = `${Math.floor((MM * nodes.along[i]) / size)},${Math.floor((MM * nodes.across[i]) / size)}`;
        if (taken.has(square)) continue;
        taken.add(square);
        chosen.push(i);
    }
    return chosen;
}

/** Arrows as one curve with gaps; the longest of all instants is a twelfth of the window. */
function arrowTrace(patch, most, kind, colour) {
    const [halfX, halfY] = windowOf(most);
    const longest = kind.most(most);
    const scale = longest > 0 ? (0.16 * Math.max(halfX, halfY)) / longest : 0;
    const x = [];
    const y = [];
    for (const i of nodesWithArrows(patch, most)) {
        const [fromX, fromY] = [MM * patch.nodes.along[i], MM * patch.nodes.across[i]];
        const [dx, dy] = [scale * patch.nodes[kind.along][i], scale * patch.nodes[kind.across][i]];
        if (!Number.isFinite(dx + dy)) continue;
        const [toX, toY] = [fromX + dx, fromY + dy];
        const side = (turn) => [
            toX - 0.3 * (dx * Math.cos(turn) - dy * Math.sin(turn)),
            toY - 0.3 * (dx * Math.sin(turn) + dy * Math.cos(turn)),
        ];
        for (const [px, py] of [[fromX, fromY], [toX, toY], side(0.45), [toX, toY], side(-0.45), [null, null]]) {
            x.push(px);
            y.push(py);
        }
    }
    return { x, y, mode: "lines", hoverinfo: "skip", line: { width: 1.4, color: colour } };
}

/** Nodes, not seen, with what is under the pointer. */
function pointerTrace({ nodes, count }, criterion) {
    const touching = Array.from({ length: count }, (_, i) => i).filter((i) => nodes.touching[i] > 0.5);
    const text = touching.map((i) => {
        const shear = MPA * Math.hypot(nodes.shear_along[i], nodes.shear_across[i]);
        return [
            `${digits(MM * nodes.along[i], 3)} mm along, ${digits(MM * nodes.across[i], 3)} mm across`,
            `pressure ${digits(MPA * nodes.pressure[i])} MPa`,
            `shear ${digits(shear)} of at most ${digits(MPA * nodes.traction_bound[i])} MPa`,
            `micro-slip ${digits(Math.hypot(nodes.micro_slip_along[i], nodes.micro_slip_across[i]), 3)} m/s`,
            nodes[criterion][i] > 0.5 ? "slips" : "sticks",
        ].join("<br>");
    });
    return {
        x: touching.map((i) => MM * nodes.along[i]),
        y: touching.map((i) => MM * nodes.across[i]),
        mode: "markers",
        marker: { size: 14, opacity: 0 },
        text,
        hovertemplate: "%{text}<extra></extra>",
    };
}

/** A bar of colours beside the plot, by a marker that is not seen. */
function barTrace(colourBy, most) {
    return {
        x: [null],
        y: [null],
        mode: "markers",
        hoverinfo: "skip",
        marker: {
            color: [0],
            colorscale: rampScale,
            cmin: 0,
            cmax: COLOURS[colourBy].most(most) || 1,
            showscale: true,
            colorbar: {
                title: { text: COLOURS[colourBy].text, side: "right" },
                thickness: 12,
                len: 0.9,
                outlinewidth: 0,
                x: 1.01,
                xpad: 2,
            },
        },
    };
}

/**
 * Traces and layout for Plotly of a patch, which is null where nothing touches.
 * @param colourBy one of COLOURS, or "state"
 */
export function patchPlot(patch, most, colourBy, { arrows, criterion, mesh }) {
    const [halfX, halfY] = windowOf(most);
    const traces = colourBy === STATES ? [] : [barTrace(colourBy, most)];
    if (patch) {
        if (mesh) traces.push(meshTrace(patch));
        if (arrows !== "none")
            traces.push(arrowTrace(patch, most, ARROWS_OF[arrows], colourBy === STATES ? named("--ink") : "#ff5a36"));
        traces.push(pointerTrace(patch, criterion));
    }
    const images = patch
        ? [
              {
                  source: canvasOf(patch, most, colourBy, criterion),
                  xref: "x",
                  yref: "y",
                  x: -halfX,
                  y: halfY,
                  sizex: 2 * halfX,
                  sizey: 2 * halfY,
                  sizing: "stretch",
                  layer: "below",
              },
          ]
        : [];
    const its = layout("rolling direction, mm", "lateral, mm", {
        hovermode: "closest",
        images,
        xaxis: { range: [-halfX, halfX], zeroline: false, showgrid: false, constrain: "domain" },
        yaxis: { range: [-halfY, halfY], zeroline: false, showgrid: false, scaleanchor: "x", constrain: "domain" },
        annotations: patch ? [] : [{ text: "no contact", showarrow: false, x: 0, y: 0 }],
    });
    return { traces, its };
}
