// Takes the data of the page apart: see PageBlocks in src/report/page_blocks.hpp, which packs them.

const known = new Map();

/** The numbers of a reference {block, type, count, low, step}: Float32Array, Uint32Array, or of levels Float32Array. */
export function numbers(reference) {
    if (!known.has(reference.block)) known.set(reference.block, unpack(reference));
    return known.get(reference.block);
}

/** The same of several, in their order. */
export const all = (references) => Promise.all(references.map(numbers));

/** An object of references as an object of arrays. */
export async function columns(references) {
    const names = Object.keys(references);
    const arrays = await all(names.map((name) => references[name]));
    return Object.fromEntries(names.map((name, i) => [name, arrays[i]]));
}

async function inflate(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

function outOfPlanes(bytes, size, count) {
    const whole = new Uint8Array(bytes.length);
    for (let b = 0; b < size; ++b) for (let i = 0; i < count; ++i) whole[i * size + b] = bytes[b * count + i];
    return whole.buffer;
}

function summed(values) {
    for (let i = 1; i < values.length; ++i) values[i] += values[i - 1];
    return values;
}

const NOT_KNOWN = 65535;

async function unpack({ block, type, count, low, step }) {
    const bytes = await inflate(document.getElementById(`block-${block}`).textContent);
    if (type === "float32") return new Float32Array(outOfPlanes(bytes, 4, count));
    if (type === "uint32") return summed(new Uint32Array(outOfPlanes(bytes, 4, count)));
    const levels = summed(new Uint16Array(outOfPlanes(bytes, 2, count)));
    return Float32Array.from(levels, (level) => (level === NOT_KNOWN ? NaN : low + step * level));
}
