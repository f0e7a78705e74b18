// The model in 3D with its time slider, a view for each result.
import { Vector3 } from "three";

import { Body, quantities } from "./bodies.js";
import { rampGradient } from "./colours.js";
import { choice, element, latest, tick, timeSlider } from "./elements.js";
import { VIEWS, View } from "./scene.js";
import { digits, readAs } from "./units.js";

const MOST_VIEWS = 4; // side by side
const SCALES = [1, 10, 100, 1000];
const LEFT_OUT = 0.01; // of the values at either end of the scale
const ENDS = { all: "all instants", most: "without 1 % at its ends", instant: "this instant" };

let open = []; // views that are drawn now

const middleOf = (bodies) => {
    const sum = new Vector3();
    let count = 0;
    for (const { places } of bodies)
        for (const place of places) {
            sum.x += place[0];
            sum.y += place[1];
            sum.z += place[2];
            ++count;
        }
    return sum.divideScalar(Math.max(1, count));
};

/** A view of one result. */
class Card {
    constructor(result) {
        this.result = result;
        this.bodies = result.fields.bodies.filter(({ outputs }) => outputs.length > 0).map((data) => new Body(data));
        this.off = new Set(this.bodies.filter(({ data }) => data.contained));
        this.sorted = new Map();
        this.canvas = element("div", { class: "view" });
        this.under = element("div", { class: "under" });
        this.bar = element("div", { class: "bar" });
        this.ticks = element("div", { class: "controls" });
        this.canvas.append(this.under);
        this.whole = element(
            "div",
            { class: "card" },
            element("h3", { textContent: result.name }),
            this.ticks,
            this.canvas,
            this.bar,
        );
    }

    open(onchange) {
        if (this.bodies.length > 1)
            this.ticks.replaceChildren(
                ...this.bodies.map((body) =>
                    tick(body.name, !this.off.has(body), (on) => {
                        if (on) this.off.delete(body);
                        else this.off.add(body);
                        onchange();
                    }),
                ),
            );
        this.view = new View(this.canvas, (found) => this.#point(found));
        this.view.resize();
    }

    #point(found) {
        this.under.textContent = "";
        if (!found || !this.label) return;
        const { factor, label } = this.label;
        const value = found.body.found
            ? found.body.found.values[found.body.found.ofNodes ? found.node : found.face]
            : NaN;
        this.under.textContent = `${found.body.name}: ${digits(factor * value)} ${label}`;
    }

    /** Ends of the scale: of all instants, of these without some of the largest and smallest values, or of one. */
    async #rangeOf(quantity, shown, bodies, ends) {
        if (ends === "instant") {
            const all = bodies.flatMap(({ found }) => Array.from(found?.values ?? [])).filter(Number.isFinite);
            const values = Float64Array.from(all).sort();
            return [values[0] ?? 0, values.at(-1) ?? 0];
        }
        const name = [quantity.name, ...shown.map((body) => body.name)].join("|");
        if (!this.sorted.has(name)) {
            const parts = await Promise.all(shown.map((body) => body.sorted(quantity)));
            this.sorted.set(name, Float64Array.from(parts.flatMap((part) => Array.from(part))).sort());
        }
        const values = this.sorted.get(name);
        if (values.length === 0) return [0, 0];
        const left = ends === "most" ? Math.floor(LEFT_OUT * values.length) : 0;
        return [values[left], values[values.length - 1 - left]];
    }

    /** The bodies at the instant nearest to a time, and the ends of their scale. */
    async prepare(time, { quantity, scale, ends }) {
        const shown = this.bodies.filter((body) => !this.off.has(body));
        await Promise.all(shown.map((body) => body.load()));
        this.drawn = await Promise.all(
            shown.map(async (body) => {
                const output = body.outputAt(time);
                const found = await body.values(output, quantity);
                return { name: body.name, corners: body.corners, places: await body.places(output, scale), found };
            }),
        );
        return this.#rangeOf(quantity, shown, this.drawn, ends);
    }

    /** Draws what prepare() has made, coloured from `low` to `high`. */
    draw(low, high, { quantity, mesh, follow }) {
        const span = high > low ? high - low : 1;
        for (const body of this.drawn)
            body.colour = (face, node) =>
                body.found ? (body.found.values[body.found.ofNodes ? node : face] - low) / span : 0;
        const names = this.drawn.map(({ name }) => name).join("|");
        const middle = middleOf(this.drawn);
        if (follow && this.followed === names) this.view.follow(middle.clone().sub(this.middle));
        this.followed = names;
        this.middle = middle;
        this.view.show(this.drawn, mesh);
        if (!this.looked) this.look("iso");
        this.#label(quantity, low, high);
    }

    look(view) {
        this.looked = true;
        this.view.look(view);
    }

    #label(quantity, low, high) {
        this.label = readAs(this.result.fields.units[quantity.field] ?? "1");
        const text = (value) => digits(this.label.factor * value);
        this.bar.replaceChildren(
            element("span", { class: "low", textContent: text(low) }),
            element("span", { class: "ramp", style: `background:${rampGradient}` }),
            element("span", { class: "high", textContent: `${text(high)} ${this.label.label}` }),
            element("span", { class: "faint", textContent: quantity.text }),
        );
    }
}

const hint = (text) => element("p", { class: "faint", textContent: text });

/** Fills the section. */
export async function model(place, results) {
    for (const { view } of open) view?.dispose();
    open = [];
    const cards = results
        .slice(0, MOST_VIEWS)
        .map((result) => new Card(result))
        .filter(({ bodies }) => bodies.length > 0);
    if (cards.length === 0) {
        place.replaceChildren(
            hint(
                "These results have no fields of bodies. A case names what is to be seen here in output.field_sets" +
                    " and output.fields.",
            ),
        );
        return;
    }
    const list = quantities(cards.flatMap((card) => card.bodies.map(({ data }) => data)));
    const times = [
        ...new Set(cards.flatMap((card) => card.bodies.flatMap(({ data }) => data.outputs.map((one) => one.time)))),
    ];
    times.sort((a, b) => a - b);
    const wishes = { quantity: list[0], scale: 1, mesh: true, follow: true, ends: "most" };
    let time = times.at(-1);
    const redraw = latest(async () => {
        const now = { ...wishes };
        const ranges = await Promise.all(cards.map((card) => card.prepare(time, now)));
        // One scale for all results.
        const low = Math.min(...ranges.map((range) => range[0]));
        const high = Math.max(...ranges.map((range) => range[1]));
        for (const card of cards) card.draw(low, high, now);
    });
    const wish =
        (name, read = (value) => value) =>
        (value) => {
            wishes[name] = read(value);
            redraw();
        };
    const slider = timeSlider(times, (position) => {
        time = times[position];
        redraw();
    });
    place.replaceChildren(
        hint(
            "Drag to turn, use the wheel or two fingers to zoom, the right button or two fingers to move. What is" +
                " under the pointer is named in the corner. Seen is what the case names in output.field_sets.",
        ),
        element(
            "div",
            { class: "controls" },
            choice(
                "Colour",
                list.map(({ name, text }) => [name, text]),
                list[0].name,
                wish("quantity", (name) => list.find((one) => one.name === name)),
            ),
            choice("Scale", Object.entries(ENDS), wishes.ends, wish("ends")),
            choice(
                "Deformation",
                SCALES.map((scale) => [scale, `${scale} times`]),
                1,
                wish("scale", Number),
            ),
            tick("Mesh", wishes.mesh, wish("mesh")),
            tick("Follow", wishes.follow, wish("follow")),
            ...Object.keys(VIEWS).map((view) =>
                element("button", {
                    type: "button",
                    textContent: view,
                    onclick: () => cards.forEach((card) => card.look(view)),
                }),
            ),
        ),
        slider.whole,
        element(
            "div",
            { class: "cards" },
            cards.map(({ whole }) => whole),
        ),
    );
    try {
        for (const card of cards) card.open(redraw);
    } catch {
        place.replaceChildren(
            hint("This browser has no WebGL, or it is switched off, so that the model cannot be drawn."),
        );
        return;
    }
    open = cards;
    slider.go(times.length - 1);
    await redraw();
}
