"use strict";
// Charts of the rows of a report, drawn where their script stands: each function takes rows as they are in the JSON, and makes no number but
// places on an axis and digits.
const escaped = text => String(text).replace(/[&<>"]/g, letter => `&#${letter.charCodeAt(0)};`);
const draw = html => document.currentScript.insertAdjacentHTML("beforebegin", html);
// A number with its sign, which zero has not.
const signed = (value, digits) => {
  const text = Math.abs(value).toFixed(digits);
  return (+text === 0 ? "" : value < 0 ? "−" : "+") + text;
};
const four = value => String(+value.toPrecision(4));
// The place of a value on a logarithmic axis, 0 to 1.
const along = ([low, high], value) => Math.min(Math.max(Math.log(value / low) / Math.log(high / low), 0), 1);
const ends = values => [Math.min(...values), Math.max(...values)];
// Steps of a logarithmic axis: one, two and five times powers of ten that lie within it, or even ones where it is short.
const ticks = ([low, high]) => {
  const decade = Math.floor(Math.log10(low)), all = [];
  for (let ten = decade; ten < decade + 40; ten++) for (const part of [1, 2, 5]) all.push(+`${part}e${ten}`);
  const within = all.filter(tick => tick >= low && tick <= high), many = Math.max(Math.ceil(within.length / 5), 1);
  // One, from which factors are drawn, is always among them.
  if (within.length > 2) return within.filter((_, at) => (at - Math.max(within.indexOf(1), 0)) % many === 0);
  const rough = (high - low) / 6, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map(part => part * ten).find(part => part >= rough) || ten, even = [];
  for (let row = Math.ceil(low / step); row <= Math.floor(high / step); row++) even.push(row * step);
  return even;
};
// Factors as bars from one, the surest change first: gray where the test hardly sees them, open at a bound, a line over the 95 % interval.
const bars = parameters => {
  const key = own => own.sureness === null ? 1 : -Math.fround(own.sureness), rows = [...parameters].sort((a, b) => key(a) - key(b));
  const known = rows.flatMap(own => [own.low, own.high]).filter(end => end > 0.2 && end < 5);
  const [low, high] = ends([1 / 1.1, 1.1, ...rows.map(own => own.factor).filter(factor => factor > 0), ...known]), axis = [low / 1.02, high * 1.02];
  const at = value => `${(100 * along(axis, value)).toFixed(2)}%`;
  const line = own => `<tr class="${own.sureness === null ? "unseen" : own.remark === "at bound" ? "bound" : ""}"><th scope="row">${escaped(own.parameter)}</th>
    <td class="track"><u style="left:${at(1)}"></u><i style="left:${at(Math.min(own.factor, 1))};right:calc(100% - ${at(Math.max(own.factor, 1))})"></i>` +
    (own.low === null ? "" : `<s style="left:${at(own.low)};right:calc(100% - ${at(own.high)})"></s>`) +
    `<b style="left:${at(own.factor)}"></b></td><td>${own.factor.toFixed(3)}` +
    (own.deviation_percent === null ? "" : ` <small>± ${+own.deviation_percent.toPrecision(2)} %</small>`) + "</td></tr>";
  // Letters at an end would stand in the next column.
  const inside = ticks(axis).filter(tick => Math.abs(along(axis, tick) - 0.5) < 0.47);
  const words = [[rows.some(own => own.low !== null), " Lines: 95 % intervals."], [rows.some(own => own.sureness === null), " Gray: the test hardly sees it."],
    [rows.some(own => own.remark === "at bound"), " Open: at a bound."]].map(([is, say]) => is ? say : "").join("");
  draw(`<figure class="bars"><table><thead><tr><th scope="col">Parameter</th><td class="ticks">` +
    inside.map(tick => `<span style="left:${at(tick)}">${four(tick)}</span>`).join("") + `</td><th scope="col">Factor</th></tr></thead>
    <tbody>${rows.map(line).join("")}</tbody></table>
    <figcaption>Factors on the first model, the surest change first, on a logarithmic axis.${words}</figcaption></figure>`);
};
// A matrix as a table of colored cells; the cell of each column that is framed has a frame.
const heat = (caption, corner, rows, columns, values, full, digits, framed = []) => {
  const cell = (value, row, column) => {
    const number = signed(value, digits).replace("+", "");
    return `<td class="${value < 0 ? "minus" : "plus"}${framed[column] === row ? " framed" : ""}" style="--v:${Math.min(Math.abs(value) / full, 1).toFixed(2)}">${+number === 0 ? "" : number}</td>`;
  };
  draw(`<figure><div class="scroll" tabindex="0" role="region"><table class="heat"><thead><tr><th scope="col">${corner}</th>` +
    columns.map(name => `<th scope="col">${escaped(name)}</th>`).join("") + "</tr></thead><tbody>" +
    rows.map((name, row) => `<tr><th scope="row">${escaped(name)}</th>${values[row].map((value, column) => cell(value, row, column)).join("")}</tr>`).join("") +
    `</tbody></table></div><figcaption>${escaped(caption)}</figcaption></figure>`);
};
// Modal assurance of a model's modes and the test's, the pairs framed; nothing without shapes.
const assurance = (modes, agreement, model, when) => {
  const matrix = agreement.modal_assurance, shaped = modes.filter(own => own.first_mac !== null);
  if (!shaped.length) return;
  const pairs = shaped.map(own => own[`${model}_mode`] - 1), least = Math.min(...shaped.map(own => own[`${model}_mac`]));
  heat(`Modal assurance (MAC) of analysis modes (down) and test modes (across), in hundredths, ${when} the correction; pairs are framed. The least of a pair is ${least.toFixed(2)}.`,
    when, matrix.map((_, row) => row + 1), shaped.map(own => own.mode), matrix.map(row => row.map(value => 100 * value)), 100, 0, pairs);
};
// Residuals in standard deviations by sensor and test mode; noise alone is beyond three in 3 of 1000.
const deviations = (modes, readings) => {
  const shaped = modes.map(own => readings.filter(reading => reading.mode === own.mode)), longest = shaped.reduce((a, b) => b.length > a.length ? b : a, []);
  const values = [modes.map(own => own.residual), ...longest.map((_, row) => shaped.map(of => of[row] ? of[row].residual : 0))];
  heat("Residuals at the best factors in standard deviations, by sensor (down) and test mode (across); 3 and more have the full color.",
    "Sensor", ["frequency", ...longest.map(own => own.sensor)], modes.map(own => own.mode), values, 3, 1);
};
// Derivatives of the frequencies at the first model.
const slopes = (parameters, modes, derivatives) => {
  const values = derivatives.frequency_percent_per_percent, full = Math.max(1e-9, ...values.flat().map(Math.abs));
  heat("Percent of a test mode's frequency (across) for one percent of a parameter (down), at the first model.",
    "Parameter", parameters.map(own => own.parameter), modes.map(own => own.mode), values, full, 2);
};
// All charts of a case of the paper.
const charts = ({parameters, modes, first, corrected, derivatives}) => {
  bars(parameters);
  pairing(modes);
  assurance(modes, first, "first", "before");
  assurance(modes, corrected, "corrected", "after");
  slopes(parameters, modes, derivatives);
};
// Computed against measured frequencies with lines of ±5 %: open circles before, full ones after.
const pairing = modes => {
  const all = modes.flatMap(own => [own.test_hz, own.first_hz, own.corrected_hz]), [least, most] = ends(all);
  if (!all.length || least <= 0) return;
  const axis = [least / 1.12, most * 1.12], [low, high] = axis, x = value => 54 + 338 * along(axis, value), y = value => 400 - x(value);
  const line = (name, [a, b], [c, d]) => `<path class="${name}" d="M${x(a).toFixed(1)} ${y(b).toFixed(1)}L${x(c).toFixed(1)} ${y(d).toFixed(1)}"/>`;
  const frame = ticks(axis).map(tick => line("grid", [tick, low], [tick, high]) + line("grid", [low, tick], [high, tick]) +
    `<text x="${x(tick)}" y="365" text-anchor="middle">${four(tick)}</text><text x="48" y="${y(tick) + 5}" text-anchor="end">${four(tick)}</text>`).join("");
  const circle = (name, hertz) => own => `<circle class="${name}" cx="${x(own.test_hz).toFixed(1)}" cy="${y(own[hertz]).toFixed(1)}" r="4.5">` +
    `<title>mode ${own.mode}: ${four(own.test_hz)} Hz measured, ${four(own[hertz])} Hz computed</title></circle>`;
  const off = modes.map(own => Math.abs(own.corrected_error_percent));
  const far = modes[off.indexOf(Math.max(...off))];
  draw(`<figure class="pairing"><svg viewBox="0 0 400 400" role="img" aria-label="Computed against measured frequencies">${frame}` +
    line("equal", [low, low], [high, high]) + line("near", [low, 1.05 * low], [high / 1.05, high]) + line("near", [1.05 * low, low], [high, high / 1.05]) +
    `<text x="227" y="394" text-anchor="middle">measured, Hz</text><text transform="translate(11 173)rotate(-90)" text-anchor="middle">computed, Hz</text>` +
    modes.map(circle("open", "first_hz")).join("") + modes.map(circle("full", "corrected_hz")).join("") +
    `</svg><figcaption>Computed against measured frequencies, Hz: open before, full after the correction. ${off.filter(own => own <= 5).length} of ${off.length} lie within the
    dashed ±5 %; farthest is mode ${far.mode}, ${signed(far.corrected_error_percent, 2)} %.</figcaption></figure>`);
};
