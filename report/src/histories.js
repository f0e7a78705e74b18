// Histories: forces, energies, loads and sets against time.
import { numbers } from "./blocks.js";
import { curve } from "./colours.js";
import { choice, element } from "./elements.js";
import { draw, layout, legend, linkTimes } from "./plot.js";
import { readAs, withUnit, words } from "./units.js";

const DASHES = ["solid", "dash", "dot", "dashdot"];
const MANY = 4; // results: more than these are told apart by colour, one quantity at a time
const DWARFS = 10; // a curve so many times larger than the others' median is not drawn until it is asked for

/** The curves of one plot: {title, unit, curves: [{label, name}]}, name being the channel's. */
function groupsOf(results) {
    const channels = new Map();
    for (const { history } of results) for (const one of history.channels) channels.set(one.name, one);
    const groups = { contact: [], energy: [], load: [], set: [] };
    for (const one of channels.values()) {
        const title = one.group === "energy" ? "energies" : `${one.owner}: ${words(one.quantity)}`;
        let plot = groups[one.group].find((known) => known.title === title && known.unit === one.unit);
        if (!plot) groups[one.group].push((plot = { title, unit: one.unit, curves: [] }));
        const label = one.group === "energy" ? words(one.quantity) : one.component || words(one.quantity);
        plot.curves.push({ label, name: one.name });
    }
    for (const name of ["contact", "load", "set"]) groups[name] = inOrder(groups[name]);
    return groups;
}

const FIRST = [
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

/** The balance's error is far smaller than energies: it has a plot of its own. */
function withoutBalance(plots) {
    const isBalance = ({ name }) => name === "energy.balance_error";
    return plots.flatMap((plot) => [
        { ...plot, curves: plot.curves.filter((one) => !isBalance(one)) },
        { title: "error of the energy balance", unit: plot.unit, curves: plot.curves.filter(isBalance) },
    ]);
}

const largest = (values) => values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);

/** Whether each of these curves is too large for the others to be seen. */
function dwarfing(arrays) {
    const sizes = arrays.map(largest);
    const sorted = [...sizes].filter((size) => size > 0).sort((a, b) => a - b);
    const middle = sorted[Math.floor((sorted.length - 1) / 2)] ?? 0;
    return sizes.map((size) => size > DWARFS * middle && sorted.length > 2);
}

async function tracesOf(plot, curves, results, number) {
    const { factor } = readAs(plot.unit);
    const found = results.flatMap((result) =>
        curves.flatMap((one, c) => {
            const channel = result.history.channels.find(({ name }) => name === one.name);
            return channel ? [{ result, channel, label: one.label, c }] : [];
        }),
    );
    const values = await Promise.all(found.map(({ channel }) => numbers(channel.values)));
    const times = await Promise.all(found.map(({ result }) => numbers(result.history.time)));
    const hidden = curves.length > 1 ? dwarfing(values) : values.map(() => false);
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
        await draw(place, traces, layout("time, ms", withUnit(plot.title, label)));
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
