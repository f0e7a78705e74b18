// The contact patches with their time slider, a card for each result.
import { curve } from "./colours.js";
import { choice, element, latest, table, tick, timeSlider } from "./elements.js";
import { nearest, patchAt, patchNumbers, solution } from "./patch_data.js";
import { ARROWS_OF, COLOURS, CRITERIA, patchPlot } from "./patch_picture.js";
import { draw, layout, legend } from "./plot.js";
import { digits, quantity } from "./units.js";

const MOST_CARDS = 6; // side by side
const MPA = 1e-6;

const FIGURES = [
    ["normal force", "normal_force", "N"],
    ["longitudinal force", "creep_force", "N"],
    ["lateral force", "lateral_force", "N"],
    ["traction coefficient", "traction_coefficient", "1"],
    ["area", "area", "m2"],
    ["largest pressure", "peak_nodal_pressure", "Pa"],
    ["largest shear stress", "peak_shear", "Pa"],
    ["semi-axes along, across", null, "m"],
    ["nodes that slip, of those in contact", null, "1"],
    ["longitudinal creepage", "longitudinal_creepage", "%"],
    ["lateral creepage", "lateral_creepage", "%"],
    ["spin", "spin_creepage", "1/m"],
];

function figuresOf({ figures: f }, criterion) {
    const slipping = f[criterion.replace("slips", "slipping")];
    return FIGURES.map(([what, column, unit]) => {
        if (what.startsWith("semi-axes"))
            return [what, `${quantity(f.semi_axis_along, "m", 3)}, ${quantity(f.semi_axis_across, "m", 3)}`];
        if (what.startsWith("nodes")) return [what, `${digits(slipping)} of ${digits(f.nodes_in_contact)}`];
        if (unit === "%") return [what, Number.isFinite(f[column]) ? `${digits(100 * f[column], 3)} %` : "–"];
        return [what, quantity(f[column], unit)];
    });
}

/** Pressure times friction, pressure and shear along the centre line. */
function cutPlot(patch, most) {
    const x = patch ? patch.cut.distance.map((d) => 1e3 * d) : [];
    const of = (name, text, number, dash = "solid") => ({
        x,
        y: patch ? patch.cut[name].map((value) => MPA * value) : [],
        name: text,
        mode: "lines",
        line: { color: curve(number), width: 1.6, dash },
    });
    const half = 1.08e3 * most.along;
    return {
        traces: [
            of("pressure", "pressure", 0),
            of("traction_bound", "friction times pressure", 1, "dash"),
            of("shear_along", "shear, longitudinal", 2),
            of("shear_across", "shear, lateral", 3),
        ],
        its: layout("rolling direction, mm", "stress, MPa", {
            xaxis: { range: [-half, half] },
            yaxis: { range: [-MPA * (1.1 * most.below + 0.02 * most.pressure), 1.1 * MPA * most.pressure] },
        }),
    };
}

/** What is below the patch: how long arrows are, and what colours mean. */
function key(most, { arrows }) {
    if (arrows === "none") return element("p");
    const kind = ARROWS_OF[arrows];
    const text = `longest arrow of all instants: ${digits(kind.factor * kind.most(most), 3)} ${kind.unit} ${kind.text}`;
    return element("p", { class: "faint key", textContent: text });
}

const stateKey = () =>
    element(
        "p",
        { class: "faint key" },
        ...[
            ["stick", "sticks"],
            ["slip", "slips"],
        ].flatMap(([name, text]) => [
            element("span", { class: "swatch", style: `background:var(--${name})` }),
            ` ${text}   `,
        ]),
    );

/** A card of one result; `show` draws the instant nearest to a time. */
async function cardOf(result, name) {
    const contact = result.contacts.find((one) => one.name === name);
    const title = element("h3", { textContent: result.name });
    const when = element("p", { class: "faint" });
    if (!contact) {
        when.textContent = `It has no contact ${name}, or its patches were not written.`;
        return { whole: element("div", { class: "card" }, title, when), times: [], numbers: [], show: () => {} };
    }
    const whole = await solution(contact);
    const kinds = ["plot patch", "", "plot patch state", "plot cut", "", "scroll figures"];
    const [map, below, states, cut, names, figures] = kinds.map((kind) => element("div", { class: kind }));
    const show = async (time, wishes, most) => {
        const instant = nearest(whole.instants, time);
        const patch = patchAt(whole, instant, wishes.patch);
        when.textContent = `${contact.surface}, t = ${(1e3 * whole.instants[instant].time).toFixed(4)} ms${
            patch ? `, patch ${patch.figures.patch}` : ""
        }`;
        for (const [plot, colourBy] of [
            [map, wishes.colourBy],
            [states, "state"],
        ]) {
            const picture = patchPlot(patch, most, colourBy, wishes);
            await draw(plot, picture.traces, picture.its);
        }
        below.replaceChildren(key(most, wishes));
        const line = cutPlot(patch, most);
        await draw(cut, line.traces, line.its);
        names.replaceChildren(legend(cut, line.traces));
        figures.replaceChildren(...(patch ? [table(["at this instant", ""], figuresOf(patch, wishes.criterion))] : []));
    };
    return {
        whole: element(
            "div",
            { class: "card" },
            title,
            when,
            element(
                "div",
                { class: "pair" },
                element("div", {}, map, below, states, stateKey()),
                element("div", {}, cut, names, figures),
            ),
        ),
        times: whole.instants.map((one) => one.time),
        numbers: patchNumbers(whole),
        most: whole.most,
        hasSolver: Number.isFinite(whole.nodes.slips_by_solver[0]),
        show,
    };
}

/** Fills the section. */
export async function patches(place, results) {
    const contacts = [...new Set(results.flatMap((result) => result.contacts.map(({ name }) => name)))];
    if (contacts.length === 0) {
        place.replaceChildren(element("p", { textContent: "These results have no contact solution." }));
        return;
    }
    const wishes = { colourBy: "pressure", arrows: "shear", criterion: "slips_by_solver", mesh: true, patch: 0 };
    const cards = element("div", { class: "cards" });
    const bar = element("div");
    let time = Infinity;
    let shown = [];
    let most = {}; // largest values of all that is shown: one scale for all results
    const redraw = latest(() => Promise.all(shown.map((card) => card.show(time, wishes, most))));
    const wish =
        (name, read = (value) => value) =>
        (value) => {
            wishes[name] = read(value);
            redraw();
        };
    const texts = (table_) => Object.entries(table_).map(([value, one]) => [value, one.text ?? one]);
    const choose = async (name) => {
        shown = await Promise.all(results.slice(0, MOST_CARDS).map((result) => cardOf(result, name)));
        most = {};
        for (const card of shown)
            for (const [what, value] of Object.entries(card.most ?? {})) most[what] = Math.max(most[what] ?? 0, value);
        const times = [...new Set(shown.flatMap((card) => card.times))].sort((a, b) => a - b);
        const numbers = [...new Set(shown.flatMap((card) => card.numbers))];
        if (!shown.some((card) => card.hasSolver)) wishes.criterion = "slips_by_force";
        wishes.patch = 0;
        const slider = timeSlider(times, (position) => {
            time = times[position];
            redraw();
        });
        cards.replaceChildren(...shown.map(({ whole }) => whole));
        bar.replaceChildren(
            element(
                "div",
                { class: "controls" },
                choice(
                    "Contact",
                    contacts.map((one) => [one, one]),
                    name,
                    choose,
                ),
                choice(
                    "Patch",
                    [[0, "largest force"], ...(numbers.length > 1 ? numbers.map((n) => [n, `number ${n}`]) : [])],
                    0,
                    wish("patch", Number),
                ),
                choice("Colour", texts(COLOURS), wishes.colourBy, wish("colourBy")),
                choice("Arrows", [...texts(ARROWS_OF), ["none", "none"]], wishes.arrows, wish("arrows")),
                choice("Slip", texts(CRITERIA), wishes.criterion, wish("criterion")),
                tick("Mesh", wishes.mesh, wish("mesh")),
            ),
            slider.whole,
        );
        slider.go(times.length - 1);
        await redraw();
    };
    const more = results.length - MOST_CARDS;
    place.replaceChildren(
        bar,
        ...(more > 0
            ? [element("p", { class: "faint", textContent: `${more} more results: choose which are shown above.` })]
            : []),
        cards,
    );
    await choose(contacts[0]);
}
