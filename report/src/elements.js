// Elements of the page, made in one call.

/** An element with attributes and children; text is never read as HTML. */
export function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
        else if (key === "class") made.className = value;
        else if (key in made && key !== "list") made[key] = value;
        else made.setAttribute(key, value);
    }
    made.append(...children.flat().filter((child) => child !== null && child !== undefined));
    return made;
}

/** A drop-down list with its label; `choices` are [value, text]. Hidden where there is no choice. */
export function choice(label, choices, chosen, onchange) {
    const list = element("select", { onchange: () => onchange(list.value) });
    list.append(...choices.map(([value, text]) => element("option", { value, textContent: text })));
    if (chosen !== undefined) list.value = chosen;
    const whole = element("label", {}, label, list);
    whole.hidden = choices.length < 2;
    if (whole.hidden) whole.style.display = "none";
    return whole;
}

/** A tick box with its label. */
export function tick(label, checked, onchange) {
    const box = element("input", { type: "checkbox", checked, onchange: () => onchange(box.checked) });
    return element("label", {}, box, label);
}

/** A table: heading cells and rows of cells; a cell is text or a number, which is put to the right. */
export function table(heading, rows) {
    const cell = (kind) => (content) =>
        element(
            kind,
            { class: isNumber(content) ? "number" : "" },
            content instanceof Node ? content : String(content),
        );
    return element(
        "table",
        {},
        element("thead", {}, element("tr", {}, heading.map(cell("th")))),
        element(
            "tbody",
            {},
            rows.map((row) => element("tr", {}, row.map(cell("td")))),
        ),
    );
}

const isNumber = (content) => typeof content === "string" && /^[-–]?[0-9.]*(e[-+][0-9]+)?$/.test(content);

/**
 * A function that does the work one call at a time: calls that come while it is at work are one more call after that,
 * so that a slider is never behind.
 */
export function latest(work) {
    let running = null;
    let again = false;
    const go = async () => {
        do {
            again = false;
            await work();
        } while (again);
        running = null;
    };
    return () => {
        again = true;
        return (running ??= go());
    };
}

/** A time slider with a button that plays: `times` in s, onchange is given the position. */
export function timeSlider(times, onchange) {
    const shown = element("output");
    const slider = element("input", { type: "range", min: 0, max: Math.max(0, times.length - 1), step: 1 });
    slider.setAttribute("aria-label", "time");
    let timer = null;
    const go = (position) => {
        slider.value = position;
        shown.textContent = `t = ${(1e3 * times[position]).toFixed(4)} ms`;
        onchange(position);
    };
    const stop = () => {
        clearInterval(timer);
        timer = null;
        play.textContent = "Play";
    };
    const play = element("button", {
        type: "button",
        textContent: "Play",
        onclick: () => {
            if (timer) return stop();
            play.textContent = "Stop";
            timer = setInterval(() => go((Number(slider.value) + 1) % times.length), 250);
        },
    });
    slider.addEventListener("input", () => go(Number(slider.value)));
    slider.addEventListener("pointerdown", stop);
    const whole = element("div", { class: "time" }, play, slider, shown);
    return { whole, go, stop };
}

/** Has the browser save a text as a file. */
export function save(name, text) {
    const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
    const link = element("a", { href: address, download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
}
