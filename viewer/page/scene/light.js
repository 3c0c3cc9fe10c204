// Sun, sky and fog. The sun's shadows fall on ground, walls and bodies; fog takes colours into the background's.

import {AmbientLight, DirectionalLight, FogExp2, HemisphereLight, PCFSoftShadowMap, ShaderChunk, Vector3} from 'three';

const from_sun = new Vector3(-0.6, -1, 2).normalize();
const extinctions_to_see = 3.9;  // visibility x extinction, by Koschmieder's law: 2 % of the contrast are left
const shadow_pixels = 2048;

// three's law is exp(-(extinction x distance)^2); that of the air, and of sensors.camera, has no square (Beer and Lambert).
const squared = 'exp( - fogDensity * fogDensity * vFogDepth * vFogDepth )';
if (!ShaderChunk.fog_fragment.includes(squared)) throw new Error('the fog of three is another than expected');
ShaderChunk.fog_fragment = ShaderChunk.fog_fragment.replace(squared, 'exp( - fogDensity * vFogDepth )');

export class Light {
  constructor(stage) {
    this.stage = stage;
    this.sun = new DirectionalLight(0xffffff, 1.5);
    this.sun.position.copy(from_sun);
    this.set_shadows(true);
    this.sun.shadow.mapSize.set(shadow_pixels, shadow_pixels);
    this.sun.shadow.intensity = 0.6;
    Object.assign(stage.renderer.shadowMap, {enabled: true, type: PCFSoftShadowMap});
    stage.scene.add(new HemisphereLight(0xffffff, 0x8a8f98, 1.6), new AmbientLight(0xffffff, 0.5), this.sun);
  }

  /** What is lit casts shadows, but for ground and slabs: a ceiling would darken all below. The sun's are those of the box. */
  cover(box) {
    this.stage.scene.traverse((object) => {
      if (!object.material?.isMeshLambertMaterial) return;
      object.receiveShadow = true;
      object.castShadow = !/^(ground|floor )/.test(object.name);
    });
    const centre = box.getCenter(new Vector3()), reach = box.getSize(new Vector3()).length() / 2 + 0.5;
    this.sun.target.position.copy(centre);
    this.sun.target.updateMatrixWorld();
    this.sun.position.copy(centre).addScaledVector(from_sun, 2 * reach);
    const {camera} = this.sun.shadow;
    Object.assign(camera, {left: -reach, right: reach, bottom: -reach, top: reach, near: 0.5 * reach, far: 3.5 * reach});
    camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 4 * reach / shadow_pixels;  // two of its pixels: a lit face does not shade itself
  }

  set_shadows(on) {
    this.sun.castShadow = on;
  }

  /** [m], 0: no fog. */
  set_visibility(visibility) {
    const {scene} = this.stage;
    scene.fog = visibility > 0 ? new FogExp2(scene.background, extinctions_to_see / visibility) : null;
  }

  recolour() {
    this.stage.scene.fog?.color.copy(this.stage.scene.background);
  }
}

/** Three visibilities [m] in which a scene of that size is veiled a little, much, and lost but for what is near. */
export function visibilities(box) {
  const size = box.getSize(new Vector3()).length();
  return [10, 4, 1.5].map((times) => Number((times * size).toPrecision(1)));
}
