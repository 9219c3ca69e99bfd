"use strict";
// Displacements of all places of a state (0 test, 1 first, 2 corrected) in a mode, largest one; of the difference from the test where that
// is asked for; null where there is no shape.
const motion = (mode, state, isDifference) => {
  const own = mode.moved[state], test = mode.moved[0];
  if (own.length === 0) return null;
  const parts = isDifference && state > 0 && test.length ? own.map((part, at) => part - test[at]) : own;
  return Array.from({ length: own.length / 3 }, (_, node) => [0, 1, 2].map(axis => parts[3 * node + axis] / 1000));
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
// Places of a state at a phase, in degrees: motions are drawn an eighth of the structure long, and heights as many times as they need.
const displaced = (data, moved, phase) => data.places.map((place, node) => place.map((at, axis) =>
  (axis === 2 ? data.heights : 1) * at + (moved ? 0.125 * Math.sin(phase * Math.PI / 180) * moved[node][axis] : 0)));
// A number with its sign, which zero has not.
const signed = (value, digits) => {
  const text = Math.abs(value).toFixed(digits);
  return (+text === 0 ? "" : value < 0 ? "−" : "+") + text;
};
// What a reader is told of a mode.
const sentence = mode => `Mode ${mode.number}: test ${mode.hertz[0]} Hz` + ["first", "corrected"].map((name, at) =>
  `; ${name} ${mode.hertz[at + 1]} Hz, ${signed(mode.off[at], 1)} %` + (mode.assurance ? `, MAC ${mode.assurance[at].toFixed(2)}` : "")).join("") + ".";

function moving(data) {
  const figure = document.currentScript.closest("figure"), get = name => figure.querySelector("." + name);
  const canvas = get("view"), pen = canvas.getContext("2d"), slider = get("phase"), play = get("play");
  const isCalm = matchMedia("(prefers-reduced-motion: reduce)");
  let turn = -0.6, rise = 0.5, isPlaying = !isCalm.matches, isShown = true, last = 0;
  const tones = name => getComputedStyle(figure).getPropertyValue("--" + name).trim();
  const mode = () => data.modes[+figure.querySelector(".modes input:checked").value];
  const most = Math.max(0.05, ...data.parameters.map(it => it.isSeen ? Math.abs(it.change) : 0));
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
      const all = displaced(data, null, 0).map(place => project(place, turn_, rise_)[axis]);
      return [Math.min(...all), Math.max(...all)];
    });
    // As high as the structure asks for as it first stands.
    const [asked, above] = size(-0.6, 0.5).map(([low, high_]) => high_ - low);
    const high = Math.min(Math.max((cell - 12) / (asked + 0.08) * (above + 0.22) + 48, 170), 340);
    canvas.width = ratio * wide; canvas.height = ratio * high * 3 / across; canvas.style.height = high * 3 / across + "px";
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const isFine = data.pieces.length > 400, now = mode(), isDifference = get("difference").checked, kind = get("color").value, phase = +slider.value;
    const plus = tones("plus"), minus = tones("minus"), soft = tones("soft"), hatch = hatched(soft);
    const [[left, right], [top, bottom]] = size(turn, rise);
    const scale = Math.min((cell - 12) / (right - left + 0.08), (high - 48) / (bottom - top + 0.22));
    ["test", "first", "corrected"].forEach((name, state) => {
      const moved = motion(now, state, isDifference), along = moved ? mainAxis(moved) : 2;
      const [x, y] = [cell * (state % across + 0.5), high * (Math.floor(state / across) + 0.5) + 20];
      const spot = ([right_, down]) => [x + scale * (right_ - 0.5 * (left + right)), y + scale * (down - 0.5 * (top + bottom))];
      const at = displaced(data, moved, phase).map(place => project(place, turn, rise));
      pen.fillStyle = ink; pen.textAlign = "center"; pen.lineJoin = "round";
      pen.font = "600 14px sans-serif";
      pen.fillText(`${name} ${now.hertz[state]} Hz`, x, y - 0.5 * high - 4);
      pen.font = "13px sans-serif"; pen.fillStyle = soft;
      const beside = state ? `${signed(now.off[state - 1], 1)} %` + (now.assurance ? `, MAC ${now.assurance[state - 1].toFixed(2)}` : "") : moved ? "" : "its shape was not measured";
      pen.fillText(isDifference && state && moved && now.moved[0].length ? "difference from the test" : beside, x, y - 0.5 * high + 14);
      const order = data.pieces.map(piece => [piece, piece.nodes.reduce((sum, node) => sum + at[node][2], 0) / piece.nodes.length]);
      for (const [piece] of order.sort((one, other) => one[1] - other[1])) {
        const isLine = piece.nodes.length < 3, own = piece.owners.map(e => data.parameters[e]);
        let color = soft, strength = isLine ? 0.5 : 0.06;
        if (kind === "motion" && moved) {
          const mean = piece.nodes.reduce((sum, node) => sum + moved[node][along], 0) / piece.nodes.length * (isDifference ? 1 : Math.sin(phase * Math.PI / 180));
          if (Math.abs(mean) > 0.01) [color, strength] = [mean < 0 ? minus : plus, 0.08 + 0.8 * Math.min(1, Math.abs(mean)) + (isLine ? 0.1 : 0)];
        } else if (kind === "factors" && own.length) {
          const seen = own.filter(it => it.isSeen), change = seen.reduce((far, it) => Math.abs(it.change) > Math.abs(far) ? it.change : far, 0);
          [color, strength] = seen.length ? [change < 0 ? minus : plus, 0.1 + 0.85 * Math.abs(change) / most] : [hatch, 0.9];
        } else if (piece.owners.includes(+kind)) [color, strength] = [plus, 0.8];
        pen.beginPath();
        piece.nodes.forEach((node, row) => row ? pen.lineTo(...spot(at[node])) : pen.moveTo(...spot(at[node])));
        pen.globalAlpha = strength;
        if (isLine) { pen.strokeStyle = color; pen.lineWidth = isFine ? 1 : color === soft ? 1.5 : 4; pen.stroke(); continue; }
        pen.closePath(); pen.fillStyle = color; pen.fill();
        // The edges of thousands of elements would hide them.
        if (isFine) continue;
        pen.globalAlpha = 0.35; pen.strokeStyle = ink; pen.lineWidth = 0.7; pen.stroke();
      }
      pen.globalAlpha = 1;
      for (const [node, row] of data.sensors) {
        const off = kind === "residuals" && state === 2 && now.residuals ? now.residuals[row] : null, [across_, down] = spot(at[node]);
        pen.beginPath();
        pen.arc(across_, down, off === null ? (isFine ? 1 : 2.2) : 2 + 2.2 * Math.min(4, Math.abs(off)), 0, 7);
        pen.fillStyle = off === null ? soft : off < 0 ? minus : plus;
        pen.globalAlpha = off === null ? 0.9 : 0.75; pen.fill();
      }
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
  get("modes").onchange = get("difference").onchange = get("color").onchange = () => draw();
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
if (typeof module === "object") module.exports = { motion, project, mainAxis, displaced, sentence, signed };
