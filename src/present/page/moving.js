// Displacements of all places in a mode (a row of the report), of the first (1) or the corrected model (2); null where they are not known.
const motion = (data, at, state) => {
  const moved = state ? data.drawing.moved[state - 1][at] : undefined;
  return moved ? moved.map(parts => parts.map(part => part / 1000)) : null;
};
// Right, down and toward the reader, of a place seen from a side (turn) and from above (rise).
const project = ([x, y, z], turn, rise) => {
  const right = x * Math.cos(turn) - y * Math.sin(turn), back = x * Math.sin(turn) + y * Math.cos(turn);
  return [right, back * Math.sin(rise) - z * Math.cos(rise), back * Math.cos(rise) + z * Math.sin(rise)];
};
// The axis along which a mode moves most.
const mainAxis = moved => {
  const sums = [0, 1, 2].map(axis => moved.reduce((sum, at) => sum + at[axis] ** 2, 0));
  return sums.indexOf(Math.max(...sums));
};
// Places about their middle in units of the largest extent, heights as many times as large as they need to be seen.
const centered = places => {
  const extent = [0, 1, 2].map(axis => ends(places.map(place => place[axis]))), sizes = extent.map(([low, high]) => high - low);
  const size = Math.max(...sizes) || 1, tall = sizes[2] > 1e-6 * size ? Math.min(Math.max(Math.round(0.3 * size / sizes[2]), 1), 7) : 1;
  return places.map(place => place.map((at, axis) => (axis === 2 ? tall : 1) * (at - 0.5 * (extent[axis][0] + extent[axis][1])) / size));
};
// A place displaced at a phase, in degrees: a motion of one is drawn an eighth of the structure long.
const displaced = (place, moved, phase) => place.map((at, axis) => at + (moved ? 0.125 * Math.sin(phase * Math.PI / 180) * moved[axis] : 0));
// The words that tell a reader of a mode.
const sentence = own => `Mode ${own.mode}: test ${four(own.test_hz)} Hz` + ["first", "corrected"].map(name =>
  `; ${name} ${four(own[name + "_hz"])} Hz, ${signed(own[name + "_error_percent"], 1)} %` + (own[name + "_mac"] === null ? "" : `, MAC ${own[name + "_mac"].toFixed(2)}`)).join("") + ".";
let figures = 0;

function moving(data) {
  const figure = document.currentScript.closest("figure"), get = name => figure.querySelector("." + name);
  const canvas = get("view"), pen = canvas.getContext("2d"), slider = get("phase"), play = get("play");
  const isCalm = matchMedia("(prefers-reduced-motion: reduce)");
  let turn = -0.6, rise = 0.5, isPlaying = !isCalm.matches, isShown = true, last = 0;
  const { pieces, sensors } = data.drawing, places = centered(data.drawing.places), group = `moving-${figures++}`;
  const readings = data.modes.map(mode => data.readings.filter(own => own.mode === mode.mode));
  data.modes.forEach((mode, at) => get("modes").insertAdjacentHTML("beforeend",
    `<label><input type="radio" name="${group}" value="${at}"${at ? "" : " checked"}>${mode.mode}: ${four(mode.test_hz)} Hz</label> `));
  const offer = (value, words) => get("color").add(new Option(words, value));
  if (pieces.some(([, owners]) => owners.length)) {
    offer("factors", "factors");
    data.parameters.forEach((own, at) => offer(at, `where ${own.parameter} is`));
  }
  if (data.readings.some(own => own.residual !== null)) offer("residuals", "residuals at sensors");
  const tones = name => getComputedStyle(figure).getPropertyValue("--" + name).trim();
  const shown = () => +figure.querySelector(".modes input:checked").value;
  const change = own => Math.log(own.factor), most = Math.max(0.05, ...data.parameters.map(own => own.sureness === null ? 0 : Math.abs(change(own))));
  const hatched = color => {
    const tile = document.createElement("canvas"), ink = tile.getContext("2d");
    tile.width = tile.height = 6;
    ink.strokeStyle = color;
    ink.beginPath(); ink.moveTo(-1, 7); ink.lineTo(7, -1); ink.moveTo(-1, 1); ink.lineTo(1, -1); ink.moveTo(5, 7); ink.lineTo(7, 5); ink.stroke();
    return pen.createPattern(tile, "repeat");
  };
  const draw = (ink = tones("ink")) => {
    const ratio = window.devicePixelRatio || 1, wide = canvas.clientWidth || 720, across = wide < 520 ? 1 : 3;
    const cell = wide / across, size = (turn_, rise_) => [0, 1].map(axis => {
      const all = places.map(place => project(place, turn_, rise_)[axis]);
      return [Math.min(...all), Math.max(...all)];
    });
    // As high as the structure asks for as it first stands.
    const [asked, above] = size(-0.6, 0.5).map(([low, high_]) => high_ - low);
    const high = Math.min(Math.max((cell - 12) / (asked + 0.08) * (above + 0.22) + 48, 170), 340);
    canvas.width = ratio * wide; canvas.height = ratio * high * 3 / across; canvas.style.height = high * 3 / across + "px";
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const isFine = pieces.length > 400, at_ = shown(), now = data.modes[at_], kind = get("color").value, phase = +slider.value;
    const plus = tones("plus"), minus = tones("minus"), soft = tones("soft"), hatch = hatched(soft);
    const [[left, right], [top, bottom]] = size(turn, rise);
    const scale = Math.min((cell - 12) / (right - left + 0.08), (high - 48) / (bottom - top + 0.22));
    ["test", "first", "corrected"].forEach((name, state) => {
      const moved = motion(data, at_, state), main = moved ? mainAxis(moved) : 2;
      const [x, y] = [cell * (state % across + 0.5), high * (Math.floor(state / across) + 0.5) + 20];
      const spot = ([right_, down]) => [x + scale * (right_ - 0.5 * (left + right)), y + scale * (down - 0.5 * (top + bottom))];
      const at = places.map((place, node) => project(displaced(place, moved && moved[node], phase), turn, rise));
      pen.fillStyle = ink; pen.textAlign = "center"; pen.lineJoin = "round";
      pen.font = "600 14px sans-serif";
      pen.fillText(`${name} ${four(now[name + "_hz"])} Hz`, x, y - 0.5 * high - 4);
      pen.font = "13px sans-serif"; pen.fillStyle = soft;
      const mac = now[name + "_mac"], own = readings[at_];
      const beside = state ? `${signed(now[name + "_error_percent"], 1)} %` + (mac === null ? "" : `, MAC ${mac.toFixed(2)}`) : own.length ? "at its sensors" : "its shape was not measured";
      pen.fillText(beside, x, y - 0.5 * high + 14);
      const order = pieces.map(piece => [piece, piece[0].reduce((sum, node) => sum + at[node][2], 0) / piece[0].length]);
      for (const [[nodes, owners]] of order.sort((one, other) => one[1] - other[1])) {
        const isLine = nodes.length < 3, scaled = owners.map(e => data.parameters[e]);
        let color = soft, strength = isLine ? 0.5 : 0.06;
        if (kind === "motion" && moved) {
          const mean = nodes.reduce((sum, node) => sum + moved[node][main], 0) / nodes.length * Math.sin(phase * Math.PI / 180);
          if (Math.abs(mean) > 0.01) [color, strength] = [mean < 0 ? minus : plus, 0.08 + 0.8 * Math.min(1, Math.abs(mean)) + (isLine ? 0.1 : 0)];
        } else if (kind === "factors" && scaled.length) {
          const seen = scaled.filter(it => it.sureness !== null), far = seen.reduce((far, it) => Math.abs(change(it)) > Math.abs(far) ? change(it) : far, 0);
          [color, strength] = seen.length ? [far < 0 ? minus : plus, 0.1 + 0.85 * Math.abs(far) / most] : [hatch, 0.9];
        } else if (owners.includes(+kind)) [color, strength] = [plus, 0.8];
        pen.beginPath();
        nodes.forEach((node, row) => row ? pen.lineTo(...spot(at[node])) : pen.moveTo(...spot(at[node])));
        pen.globalAlpha = strength;
        if (isLine) { pen.strokeStyle = color; pen.lineWidth = isFine ? 1 : color === soft ? 1.5 : 4; pen.stroke(); continue; }
        pen.closePath(); pen.fillStyle = color; pen.fill();
        // The edges of thousands of elements would hide them.
        if (isFine) continue;
        pen.globalAlpha = 0.35; pen.strokeStyle = ink; pen.lineWidth = 0.7; pen.stroke();
      }
      pen.globalAlpha = 1;
      sensors.forEach((sensor, row) => {
        if (!sensor) return;
        const [node, axis] = sensor, reading = own[row], off = kind === "residuals" && state === 2 && reading ? reading.residual : null;
        const [across_, down] = spot(at[node]), color = off === null ? soft : off < 0 ? minus : plus;
        pen.fillStyle = color; pen.globalAlpha = 0.85;
        pen.beginPath();
        pen.arc(across_, down, off === null ? (isFine ? 1 : 2.2) : 2 + 2.2 * Math.min(4, Math.abs(off)), 0, 7);
        pen.fill();
        // Where no more is known than what the sensors say, arrows show it.
        if (moved || !reading) return;
        const [to, aside] = spot(project(displaced(places[node], axis.map(part => part * reading[name]), phase), turn, rise));
        const tall = Math.hypot(to - across_, aside - down), [right_, low_] = [(to - across_) / (tall || 1), (aside - down) / (tall || 1)], tip = Math.min(6, tall);
        pen.strokeStyle = pen.fillStyle = reading[name] * Math.sin(phase * Math.PI / 180) < 0 ? minus : plus; pen.lineWidth = 2;
        pen.beginPath(); pen.moveTo(across_, down); pen.lineTo(to, aside); pen.stroke();
        pen.beginPath(); pen.moveTo(to, aside); pen.lineTo(to - tip * (right_ + 0.5 * low_), aside - tip * (low_ - 0.5 * right_));
        pen.lineTo(to - tip * (right_ - 0.5 * low_), aside - tip * (low_ + 0.5 * right_)); pen.fill();
      });
      pen.globalAlpha = 1;
    });
    const words = sentence(now);
    if (get("sentence").textContent !== words) get("sentence").textContent = words;
    slider.setAttribute("aria-valuetext", `${Math.round(phase)} degrees`);
  };
  const step = time => {
    if (isPlaying && isShown) { slider.value = (+slider.value + Math.min(time - last, 100) * 0.12) % 360; draw(); }
    last = time;
    if (isPlaying) requestAnimationFrame(step);
  };
  const run = whether => { isPlaying = whether; play.textContent = whether ? "Stop" : "Move"; if (whether) requestAnimationFrame(time => { last = time; step(time); }); };
  play.onclick = () => run(!isPlaying);
  slider.oninput = () => { run(false); draw(); };
  get("modes").onchange = get("color").onchange = () => draw();
  const rotate = (right, up) => { turn += right; rise = Math.max(-1.57, Math.min(1.57, rise + up)); draw(); };
  canvas.onpointerdown = event => {
    canvas.setPointerCapture(event.pointerId);
    canvas.onpointermove = to => rotate(0.01 * to.movementX, 0.01 * to.movementY);
  };
  canvas.onpointerup = canvas.onpointercancel = () => { canvas.onpointermove = null; };
  canvas.onkeydown = event => {
    const way = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (way) rotate(...way);
    else if (event.key === " ") run(!isPlaying);
    else if (event.key === "Home") { [turn, rise] = [-0.6, 0.5]; draw(); }
    else return;
    event.preventDefault();
  };
  isCalm.addEventListener("change", () => { if (isCalm.matches) { run(false); slider.value = 90; draw(); } });
  addEventListener("resize", () => draw());
  addEventListener("beforeprint", () => { run(false); slider.value = 90; draw("#222"); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => draw());
  new IntersectionObserver(all => { isShown = all[0].isIntersecting; }).observe(canvas);
  draw(); run(isPlaying);
}
