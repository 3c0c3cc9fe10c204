// Robots' bodies from their descriptions: boxes, cylinders, spheres, meshes and half-circle legs, each in its link's frame.

import {BoxGeometry, BufferGeometry, CylinderGeometry, Float32BufferAttribute, Group, Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, TorusGeometry} from 'three';

const leg_thickness = 0.012;  // [m] a leg is drawn as a bent rod

function geometry_of(part) {
  switch (part.shape) {
    case 'box': return new BoxGeometry(...part.size);
    case 'sphere': return new SphereGeometry(part.radius, 20, 12);
    case 'cylinder': return new CylinderGeometry(part.radius, part.radius, part.length, 24).rotateX(Math.PI / 2);  // along z
    case 'leg': {  // hangs from the hip at the origin and bulges backwards
      const arc = new TorusGeometry(part.radius, leg_thickness / 2, 8, 20, Math.PI);
      return arc.rotateZ(Math.PI / 2).rotateX(Math.PI / 2).translate(0, 0, -part.radius);
    }
    default: {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new Float32BufferAttribute(part.vertices, 3));
      geometry.setIndex(part.faces);
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      return flat;
    }
  }
}

export function place(object, at, turn) {
  object.position.set(...at);
  object.quaternion.copy(new Quaternion(turn[1], turn[2], turn[3], turn[0]));
}

/** A body as a group: userData.movers has the groups that a recorded column turns. */
export class Bodies {
  constructor(models) {
    this.models = new Map(models.map((model) => [model.name, model]));
    this.geometries = new Map();
  }

  make(model_name, colour) {
    const model = this.models.get(model_name);
    const body = new Group();
    body.userData = {movers: [], parts: 0, radius: model?.radius ?? 0.15};
    const main = new MeshLambertMaterial({color: colour});
    const other = new MeshLambertMaterial({color: '#3c434d'});
    body.userData.recolour = (fresh) => main.color.set(fresh);
    const joints = (model?.joints ?? []).map((joint) => {
      const frame = new Group();
      place(frame, joint.at, joint.turn);
      body.add(frame);
      const mover = new Group();
      frame.add(mover);
      body.userData.movers.push({...joint, mover});
      return mover;
    });
    const parts = model?.parts ?? [{shape: 'cylinder', radius: 0.1, length: 0.2, at: [0, 0, 0.1], turn: [1, 0, 0, 0], main: true}];
    parts.forEach((part, i) => {
      const key = `${model_name}/${i}`;
      if (!this.geometries.has(key)) this.geometries.set(key, geometry_of(part));
      const mesh = new Mesh(this.geometries.get(key), part.main ? main : other);
      place(mesh, part.at, part.turn);
      (part.joint === undefined ? body : joints[part.joint]).add(mesh);
      ++body.userData.parts;
    });
    return body;
  }
}
