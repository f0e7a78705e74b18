// Histories: forces, energies, loads and sets against time.
import { numbers } from "./blocks.js";
import { curve } from "./colours.js";
import { choice, element } from "./elements.js";
import { draw, layout, legend, linkTimes } from "./plot.js";
import { readAs, withUnit, words } from "./units.js";

const DASHES = ["solid", "dash", "dot", "dashdot"];
const MANY = 2; // results: more than these are distinguished by colour, one quantity at a time
const DWARFS = 10; // an energy so many times larger than the internal one is not drawn until it is asked for

/**
 * The plots by what they are of: {title, unit, curves: [{label, names, of}]}; a curve is made of the channels `names`,
 * at each sample by `of` where there are several.
 */
function groupsOf(results) {
    const channels = new Map();
    for (const { history } of results) for (const one of history.channels) channels.set(one.name, one);
    const groups = { contact: [], energy: [], load: [], set: [] };
    for (const one of channels.values()) {
        const title = one.group === "energy" ? "energies" : `${one.owner}: ${words(one.quantity)}`;
        const group = groups[one.group === "prescribed_motion" ? "load" : one.group]; // forces from outside, both
        let plot = group.find((known) => known.title === title && known.unit === one.unit);
        if (!plot) group.push((plot = { title, unit: one.unit, curves: [] }));
        const label = one.group === "energy" ? words(one.quantity) : one.component || words(one.quantity);
        plot.curves.push({ label, names: [one.name] });
    }
    const owners = [...new Set(groups.contact.map(({ title }) => title.split(": ")[0]))];
    groups.contact.unshift(...owners.flatMap((owner) => derived(owner, channels)));
    for (const name of ["contact", "load", "set"]) groups[name] = inOrder(groups[name]);
    return groups;
}

const AXES = ["x", "y", "z"];

/** What people look at first of a contact: its forces in one plot, and their ratio. */
function derived(owner, channels) {
    const names = (quantity) => AXES.map((axis) => `contact.${owner}.${quantity}.${axis}`);
    const [normal, tangential] = [names("normal_force"), names("tangential_force")];
    if (![...normal, ...tangential].every((name) => channels.has(name))) return [];
    const size = (...parts) => Math.hypot(...parts);
    const ratio = (...parts) => {
        const load = size(...parts.slice(0, 3));
        return load > 0 ? size(...parts.slice(3)) / load : NaN;
    };
    const forces = [
        { label: "normal", names: normal, of: size },
        { label: "tangential", names: tangential, of: size },
        { label: "tangential x", names: [tangential[0]] },
        { label: "tangential y", names: [tangential[1]] },
    ];
    const of = { label: "tangential over normal force", names: [...normal, ...tangential], of: ratio };
    return [
        { title: `${owner}: forces`, unit: "N", curves: forces },
        { title: `${owner}: tangential over normal force`, unit: "1", curves: [of] },
    ];
}

const FIRST = [
    "forces",
    "tangential over normal force",
    "normal_force",
    "tangential_force",
    "nodes_in_contact",
    "nodes_slipping",
    "displacement",
    "velocity",
].map(words);

/** Plots in the order in which people ask for them. */
function inOrder(plots) {
    const place = ({ title }) => {
        const found = FIRST.indexOf(title.split(": ").at(-1));
        return found < 0 ? FIRST.length : found;
    };
    return [...plots].sort((a, b) => place(a) - place(b));
}

const inEnergyOrder = (curves) => [...curves].sort((a, b) => (b.label === "internal") - (a.label === "internal"));

/** The balance's error is far smaller than energies: it has a plot of its own. */
function withoutBalance(plots) {
    const isBalance = ({ names }) => names[0] === "energy.balance_error";
    return plots.flatMap((plot) => [
        { ...plot, curves: inEnergyOrder(plot.curves.filter((one) => !isBalance(one))) },
        { title: "error of the energy balance", unit: plot.unit, curves: plot.curves.filter(isBalance) },
    ]);
}

const largest = (values) => values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);

/** Whether each of these energies is too large for the internal energy, which the first curve is, to be seen. */
function dwarfing(arrays) {
    const sizes = arrays.map(largest);
    return sizes.map((size) => sizes[0] > 0 && size > DWARFS * sizes[0]);
}

/** The values of a curve. */
async function valuesOf({ parts, of }) {
    const arrays = await Promise.all(parts.map((channel) => numbers(channel.values)));
    return of ? arrays[0].map((_, i) => of(...arrays.map((array) => array[i]))) : arrays[0];
}

async function tracesOf(plot, curves, results, number) {
    const { factor } = readAs(plot.unit);
    const found = results.flatMap((result) =>
        curves.flatMap((one, c) => {
            const parts = one.names.map((name) => result.history.channels.find((known) => known.name === name));
            return parts.every(Boolean) ? [{ result, parts, of: one.of, label: one.label, c }] : [];
        }),
    );
    const values = await Promise.all(found.map(valuesOf));
    const times = await Promise.all(found.map(({ result }) => numbers(result.history.time)));
    const hidden = plot.title === "energies" && curves.length > 1 ? dwarfing(values) : values.map(() => false);
    const several = results.length > 1;
    return found.map(({ result, label, c }, i) => ({
        x: Array.from(times[i], (t) => 1e3 * t),
        y: Array.from(values[i], (value) => factor * value),
        name: several ? (curves.length > 1 ? `${label}, ${result.name}` : result.name) : label,
        mode: "lines",
        visible: !hidden[i],
        line: {
            width: 1.6,
            color: curve(several && curves.length === 1 ? number(result) : c),
            dash: several && curves.length > 1 ? DASHES[results.indexOf(result) % DASHES.length] : "solid",
        },
    }));
}

/** A card with one plot and, where there are several, a list to choose from. */
function card(title, plots, results, number) {
    const place = element("div", { class: "plot" });
    const names = element("div");
    // Many results: one quantity at a time, a colour for each.
    const shown =
        results.length > MANY || (results.length > 1 && plots.length === 1)
            ? plots.flatMap((plot) =>
                  plot.curves.map((one) => ({
                      ...plot,
                      title: plot.curves.length > 1 ? `${plot.title}, ${one.label}` : plot.title,
                      curves: [one],
                  })),
              )
            : plots;
    const show = async (position) => {
        const plot = shown[position];
        const { label } = readAs(plot.unit);
        const traces = await tracesOf(plot, plot.curves, results, number);
        await draw(
            place,
            traces,
            layout("time, ms", withUnit(plot.title.split(": ").at(-1), label), {
                xaxis: { unifiedhovertitle: { text: "t = %{x:.7~g} ms" } },
            }),
        );
        names.replaceChildren(...(traces.length > 1 ? [legend(place, traces)] : []));
    };
    const list = choice(
        "",
        shown.map(({ title: text }, i) => [i, text]),
        0,
        show,
    );
    return {
        whole: element("div", { class: "card" }, element("h3", { textContent: title }), list, place, names),
        place,
        ready: () => show(0),
    };
}

/** Fills the section with the results shown; `number` gives the number of a result's colour. */
export async function histories(place, results, number) {
    const groups = groupsOf(results);
    const cards = [];
    const owners = [...new Set(groups.contact.map(({ title }) => title.split(": ")[0]))];
    const add = (title, plots) => {
        if (plots.length > 0) cards.push(card(title, plots, results, number));
    };
    for (const owner of owners)
        add(
            `Contact ${owner}`,
            groups.contact.filter(({ title }) => title.startsWith(`${owner}: `)),
        );
    for (const plot of withoutBalance(groups.energy))
        if (plot.curves.length > 0) add(plot.title[0].toUpperCase() + plot.title.slice(1), [plot]);
    add("Loads", groups.load);
    add("Sets and probes", groups.set);
    place.replaceChildren(
        element("p", {
            class: "faint",
            textContent:
                "Draw a box to zoom, double-click to go back; a click on a name hides a curve or brings it." +
                " The time axes move together.",
        }),
        element(
            "div",
            { class: "cards" },
            cards.map(({ whole }) => whole),
        ),
    );
    if (cards.length === 0)
        place.replaceChildren(element("p", { textContent: "These runs have written no histories." }));
    await Promise.all(cards.map(({ ready }) => ready()));
    linkTimes(cards.map((one) => one.place));
}
