// Where one looks from. Axes are a camera's: x right, y down, z forward.

const add = (a, b) => a.map((v, i) => v + b[i]);
const scale = (a, f) => a.map(v => v * f);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => scale(a, 1 / Math.hypot(...a));
// `a` turned about the unit vector `axis` (Rodrigues' formula).
const turned = (a, axis, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(a, c), scale(cross(axis, a), s)), scale(axis, dot(axis, a) * (1 - c)));
};

export class Eye {
  // `camera` of the scene; `box`: two corners of what is in it, or nothing; `up`: what is up in it, a unit vector.
  constructor(camera, box, size, up) {
    const column = k => camera.rotation.map(row => row[k]);
    this.optics = camera.lens;
    this.isChoice = camera.lens_is_a_choice;
    Object.assign(this, { position: [...camera.position], right: column(0), down: column(1), forward: column(2), up, shows: camera });
    this.fit(size);
    const middle = box.length ? scale(add(box[0], box[1]), 0.5) : [0, 0, 0];
    this.radius = box.length ? Math.max(Math.hypot(...add(box[1], scale(box[0], -1))) / 2, 1e-6) : 1;
    const ahead = dot(add(middle, scale(this.position, -1)), this.forward);
    this.distance = ahead > 0 ? ahead : this.radius;
  }

  // For pictures of another size, of the same field of view from left to right.
  fit(size) {
    const { width, height, fx, fy, cx, cy } = this.shows, by = size.width / width;
    this.size = size;
    this.lens = { fx: fx * by, fy: fy * by, cx: cx * by, cy: cy * by + (size.height - height * by) / 2 };
  }

  // All that moving changes, as numbers, and back; nothing changes for what are none.
  values() {
    return [...this.position, ...this.right, ...this.down, ...this.forward, this.distance];
  }
  restore(values) {
    if (values.length !== 13 || !values.every(Number.isFinite)) return;
    ['position', 'right', 'down', 'forward'].forEach((key, n) => { this[key] = values.slice(3 * n, 3 * n + 3); });
    [this.distance] = values.slice(12);
  }

  // What is looked at, and about which the eye turns.
  target() {
    return add(this.position, scale(this.forward, this.distance));
  }

  // Looks at `point` from where it is, level.
  lookAt(point) {
    const to = add(point, scale(this.position, -1)), distance = Math.hypot(...to);
    if (!(distance > 0)) return;
    this.distance = distance;
    this.forward = scale(to, 1 / distance);
    const right = cross(this.forward, this.up), length = Math.hypot(...right);
    // Straight up and down is no horizon.
    this.right = length > 0.05 ? scale(right, 1 / length) : unit(cross(this.down, this.forward));
    this.down = cross(this.forward, this.right);
  }

  // Radians to the right and down, about what is looked at or about the eye.
  turn(right, down, aboutTarget) {
    const target = this.target();
    // Straight up and down is where left and right change places.
    const high = Math.asin(Math.max(-1, Math.min(1, dot(this.forward, this.up))));
    const most = 1.53;
    down = Math.max(Math.min(down, high + most), high - most);
    for (const key of ['right', 'down', 'forward']) this[key] = turned(this[key], this.up, -right);
    const axis = this.right;
    for (const key of ['down', 'forward']) this[key] = turned(this[key], axis, -down);
    this.forward = unit(this.forward);
    this.right = unit(cross(this.down, this.forward));
    this.down = cross(this.forward, this.right);
    if (!aboutTarget) return;
    this.level(Math.hypot(right, down));
    this.position = add(target, scale(this.forward, -this.distance));
  }

  // Turns the horizon towards the level by at most `most` radians: without a jump, where a photograph was not level.
  level(most) {
    const roll = Math.atan2(dot(this.right, this.up), -dot(this.down, this.up));
    for (const key of ['right', 'down']) this[key] = turned(this[key], this.forward, Math.max(-most, Math.min(most, roll)));
  }

  // In shares of the distance to what is looked at.
  move(right, down, forward) {
    const step = scale(add(add(scale(this.right, right), scale(this.down, down)), scale(this.forward, forward)), this.distance);
    this.position = add(this.position, step);
  }

  // Nearer to what is looked at by factor `by` of the distance.
  near(by) {
    const target = this.target();
    this.distance = Math.max(this.distance * by, this.radius * 1e-4);
    this.position = add(target, scale(this.forward, -this.distance));
  }

  // As requests have it; each side of the picture divided by about `coarse`; with the camera's lens, or as a pinhole.
  camera(coarse = 1, throughLens = true) {
    const width = Math.max(16, Math.round(this.size.width / coarse)), height = Math.max(16, Math.round(this.size.height / coarse));
    const x = width / this.size.width, y = height / this.size.height;
    return {
      width, height, fx: this.lens.fx * x, fy: this.lens.fy * y, cx: this.lens.cx * x, cy: this.lens.cy * y, position: this.position,
      rotation: [0, 1, 2].map(i => [this.right[i], this.down[i], this.forward[i]]),
      ...(this.optics && (throughLens || !this.isChoice) ? { lens: this.optics } : {})
    };
  }
}
