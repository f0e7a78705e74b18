// The page of `railwave report`: reads its data and fills the sections.
import { about } from "./about.js";
import { curve, dark } from "./colours.js";
import { element } from "./elements.js";
import { histories } from "./histories.js";
import { model } from "./model.js";
import { patches } from "./patches.js";
import { summary } from "./summary.js";
import { tables } from "./tables.js";

const data = JSON.parse(document.getElementById("railwave-data").textContent);
const chosen = new Set(data.results);
const place = (name) => document.getElementById(`${name}-body`);
const number = (result) => data.results.indexOf(result);
const shown = () => data.results.filter((result) => chosen.has(result));

function heading() {
    const { results } = data;
    const titles = [...new Set(results.map((result) => result.summary.title))];
    const title = titles.length === 1 && titles[0] ? titles[0] : `${results.length} results`;
    document.getElementById("title").textContent = title;
    document.title = `${title} – Railwave report`;
    document.getElementById("subtitle").textContent =
        results.length === 1
            ? results[0].file
            : `${results.length} results: ${results.map(({ name }) => name).join(", ")}`;
}

function picker() {
    const field = document.getElementById("shown");
    field.hidden = data.results.length < 2;
    field.append(
        ...data.results.map((result) =>
            element(
                "label",
                {},
                element("input", {
                    type: "checkbox",
                    checked: true,
                    onchange: (event) => {
                        if (event.target.checked) chosen.add(result);
                        else chosen.delete(result);
                        if (chosen.size === 0) {
                            chosen.add(result);
                            event.target.checked = true;
                        }
                        fill();
                    },
                }),
                element("span", { class: "swatch", style: `background:${curve(number(result))}` }),
                result.name,
            ),
        ),
    );
}

/** Says so at the top of the page where something cannot be drawn. */
function fail(error) {
    document.body.dataset.failed = "1";
    const old =
        typeof DecompressionStream === "undefined" ? " This browser is too old: it needs one of 2023 or later." : "";
    document
        .querySelector("main")
        .prepend(
            element("p", {
                class: "verdict poor",
                textContent: `This page could not be drawn: ${error.message}.${old}`,
            }),
        );
    console.error(error);
}

let filling = Promise.resolve();
function fill() {
    filling = filling.then(draw).catch(fail);
    return filling;
}

async function draw() {
    const results = shown();
    const figures = await summary(place("summary"), results);
    await histories(place("histories"), results, number);
    await patches(place("patches"), results);
    await model(place("model"), results);
    await tables(place("tables"), results, figures);
    document.body.dataset.ready = "1";
}

heading();
picker();
about(place("about"), data);
dark.addEventListener("change", fill);
fill();
