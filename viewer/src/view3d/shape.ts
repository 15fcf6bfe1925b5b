import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  type Material,
  Mesh,
  Quaternion,
  Vector3,
} from "three";
import type { ViewShape } from "../contract";

const UP = new Vector3(0, 1, 0);
const ROUND = 28;
const CAP = 10;

/** A solid of the page as a mesh, in the axes of the solid. */
export function shapeMesh(shape: ViewShape, material: Material): Mesh {
  const mesh = placed(shape, material);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}

/** Points whose convex hull, grown by `radius`, is the solid. */
export function shapePoints(shape: ViewShape): { points: Vector3[]; radius: number } {
  switch (shape.kind) {
    case "capsule":
      return { points: [new Vector3(...shape.from), new Vector3(...shape.to)], radius: shape.radius };
    case "box":
      return { points: boxCorners(shape.center, shape.half, shape.turn), radius: 0 };
    case "mesh":
      return { points: shape.points.map((point) => new Vector3(...point)), radius: 0 };
  }
}

function placed(shape: ViewShape, material: Material): Mesh {
  switch (shape.kind) {
    case "capsule": {
      const from = new Vector3(...shape.from);
      const along = new Vector3(...shape.to).sub(from);
      const length = along.length();
      const mesh = new Mesh(new CapsuleGeometry(shape.radius, length, CAP, ROUND), material);
      mesh.position.copy(from).addScaledVector(along, 0.5);
      if (length > 0) mesh.quaternion.setFromUnitVectors(UP, along.divideScalar(length));
      return mesh;
    }
    case "box": {
      const [x, y, z] = shape.half;
      const mesh = new Mesh(new BoxGeometry(2 * x, 2 * y, 2 * z), material);
      mesh.position.set(...shape.center);
      mesh.quaternion.set(...shape.turn);
      return mesh;
    }
    case "mesh": {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(shape.points.flat()), 3));
      geometry.setIndex(shape.triangles.flat());
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      geometry.dispose();
      return new Mesh(flat, material);
    }
  }
}

function boxCorners(
  center: [number, number, number],
  half: [number, number, number],
  turn: [number, number, number, number],
): Vector3[] {
  const rotation = new Quaternion(...turn);
  const signs = [-1, 1];
  return signs.flatMap((x) =>
    signs.flatMap((y) =>
      signs.map((z) =>
        new Vector3(x * half[0], y * half[1], z * half[2]).applyQuaternion(rotation).add(new Vector3(...center)),
      ),
    ),
  );
}
