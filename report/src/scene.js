// Bodies drawn in 3D: faces coloured by a value, turned and zoomed with the pointer.
import {
    AmbientLight,
    BufferGeometry,
    CanvasTexture,
    DirectionalLight,
    DoubleSide,
    Float32BufferAttribute,
    LineBasicMaterial,
    LineSegments,
    LinearFilter,
    Mesh,
    MeshLambertMaterial,
    PerspectiveCamera,
    Raycaster,
    Scene,
    SRGBColorSpace,
    Vector2,
    Vector3,
    WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { ramp } from "./colours.js";

const TRIANGLES = [0, 1, 2, 0, 2, 3];
const EDGES = [0, 1, 1, 2, 2, 3, 3, 0];
export const VIEWS = {
    iso: [1, -1.4, 0.8],
    side: [0, -1, 0],
    front: [1, 0, 0],
    top: [0, 0, 1],
    below: [0, 0, -1],
};

/** The colours of the scale as a picture one pixel high; the last pixel is for values that are not known. */
function rampTexture() {
    const canvas = document.createElement("canvas");
    canvas.width = 256;
    canvas.height = 1;
    const context = canvas.getContext("2d");
    for (let i = 0; i < 256; ++i) {
        context.fillStyle = `rgb(${ramp(i / 255).join(",")})`;
        context.fillRect(i, 0, 1, 1);
    }
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.generateMipmaps = false;
    return texture;
}

export class View {
    /** Throws where the browser has no WebGL. */
    constructor(place, onpointer) {
        this.place = place;
        this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
        place.append(this.renderer.domElement);
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(35, 1, 1e-3, 1e3);
        this.camera.up.set(0, 0, 1);
        this.lamp = new DirectionalLight(0xffffff, 1.2);
        this.scene.add(new AmbientLight(0xffffff, 2.1), this.lamp, this.lamp.target);
        this.controls = new OrbitControls(this.camera, this.renderer.domElement);
        this.controls.addEventListener("change", () => this.render());
        this.material = new MeshLambertMaterial({ map: rampTexture(), side: DoubleSide });
        this.lines = new LineBasicMaterial({ color: 0x8c8c8c, transparent: true, opacity: 0.55 });
        this.drawn = [];
        this.resizes = new ResizeObserver(() => this.resize());
        this.resizes.observe(place);
        this.renderer.domElement.addEventListener("pointermove", (event) => onpointer(this.#under(event)));
        this.renderer.domElement.addEventListener("pointerleave", () => onpointer(null));
    }

    dispose() {
        this.resizes.disconnect();
        this.clear();
        this.controls.dispose();
        this.material.map.dispose();
        this.material.dispose();
        this.lines.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
    }

    clear() {
        for (const { faces, edges } of this.drawn) {
            this.scene.remove(faces, edges);
            faces.geometry.dispose();
            edges.geometry.dispose();
        }
        this.drawn = [];
    }

    /**
     * Shows bodies: [{corners, places, colour, value}], places of nodes (m), colour and value being functions of face
     * and corner: a share of the scale, and the number that it stands for.
     */
    show(bodies, mesh) {
        this.clear();
        for (const body of bodies) {
            const place = [];
            const share = [];
            const edge = [];
            body.corners.forEach((face, f) => {
                for (const c of TRIANGLES) {
                    place.push(...body.places[face[c]]);
                    share.push(Math.min(0.999, Math.max(0.001, body.colour(f, face[c]))), 0.5);
                }
                if (mesh) for (const c of EDGES) edge.push(...body.places[face[c]]);
            });
            const geometry = new BufferGeometry();
            geometry.setAttribute("position", new Float32BufferAttribute(place, 3));
            geometry.setAttribute("uv", new Float32BufferAttribute(share, 2));
            geometry.computeVertexNormals();
            const faces = new Mesh(geometry, this.material);
            const edges = new LineSegments(new BufferGeometry(), this.lines);
            edges.geometry.setAttribute("position", new Float32BufferAttribute(edge, 3));
            this.scene.add(faces, edges);
            this.drawn.push({ faces, edges, body });
        }
        this.render();
    }

    /** Looks at all that is drawn from one of VIEWS. */
    look(view) {
        const low = new Vector3(Infinity, Infinity, Infinity);
        const high = low.clone().negate();
        for (const { faces } of this.drawn) {
            faces.geometry.computeBoundingBox();
            low.min(faces.geometry.boundingBox.min);
            high.max(faces.geometry.boundingBox.max);
        }
        if (this.drawn.length === 0) return;
        const middle = low.clone().add(high).multiplyScalar(0.5);
        const toEye = new Vector3(...VIEWS[view]).normalize();
        const away = this.#distance(toEye, high.clone().sub(low).multiplyScalar(0.5));
        this.camera.near = away / 1000;
        this.camera.far = away * 100;
        this.controls.target.copy(middle);
        this.camera.position.copy(toEye.multiplyScalar(away).add(middle));
        this.camera.updateProjectionMatrix();
        this.controls.update();
        this.render();
    }

    /** How far the eye must be from the middle of a box of that half size for all its corners to be seen. */
    #distance(toEye, half) {
        const right = new Vector3().crossVectors(this.camera.up, toEye);
        if (right.lengthSq() < 1e-9) right.set(1, 0, 0);
        right.normalize();
        const up = new Vector3().crossVectors(toEye, right);
        const tangent = Math.tan((this.camera.fov / 2) * (Math.PI / 180)) / 1.08;
        let away = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const sign = (bit) => (corner & bit ? 1 : -1);
            const place = new Vector3(sign(1) * half.x, sign(2) * half.y, sign(4) * half.z);
            const needed = Math.max(
                Math.abs(place.dot(up)) / tangent,
                Math.abs(place.dot(right)) / (tangent * this.camera.aspect),
            );
            away = Math.max(away, needed + place.dot(toEye));
        }
        return away;
    }

    /** Moves eye and target along, so that a body that travels stays in view. */
    follow(way) {
        this.camera.position.add(way);
        this.controls.target.add(way);
        this.controls.update();
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.place;
        if (width === 0 || height === 0) return;
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.render();
    }

    render() {
        this.lamp.position.copy(this.camera.position);
        this.lamp.target.position.copy(this.controls.target);
        this.renderer.render(this.scene, this.camera);
    }

    /** {body, face, node, place} under the pointer, or null. */
    #under({ clientX, clientY }) {
        const box = this.renderer.domElement.getBoundingClientRect();
        const pointer = new Vector2(((clientX - box.x) / box.width) * 2 - 1, 1 - ((clientY - box.y) / box.height) * 2);
        const ray = new Raycaster();
        ray.setFromCamera(pointer, this.camera);
        const [hit] = ray.intersectObjects(
            this.drawn.map(({ faces }) => faces),
            false,
        );
        if (!hit) return null;
        const { body } = this.drawn.find(({ faces }) => faces === hit.object);
        const face = Math.floor(hit.faceIndex / 2);
        let node = body.corners[face][0];
        for (const corner of body.corners[face])
            if (
                hit.point.distanceTo(new Vector3(...body.places[corner])) <
                hit.point.distanceTo(new Vector3(...body.places[node]))
            )
                node = corner;
        return { body, face, node };
    }
}
