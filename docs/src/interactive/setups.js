// Campaigns of several set-ups whose rows share an error: the ± by rows and the ± by set-ups, and how often each contains the truth.
"use strict";
const CAMPAIGNS = 1000;
// Two-sided 95 % points of Student's t, for 1 to 19 degrees of freedom. Source: any table of the distribution.
const STUDENT = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131, 2.12, 2.11, 2.101, 2.093];
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const deviation = (values) => { const middle = mean(values); return Math.sqrt(values.reduce((sum, value) => sum + (value - middle) ** 2, 0) / (values.length - 1)); };

/** One campaign: its mean, and half the width of both intervals. The truth is zero. */
function campaign(random, { setups, rows, shared, own }) {
  const groups = Array.from({ length: setups }, () => {
    const error = shared * random.normal();
    return Array.from({ length: rows }, () => error + own * random.normal());
  });
  const all = groups.flat();
  return { middle: mean(all), byRows: (1.96 * deviation(all)) / Math.sqrt(all.length), bySetups: (STUDENT[setups - 2] * deviation(groups.map(mean))) / Math.sqrt(setups) };
}

function draw() {
  const settings = Object.fromEntries(["setups", "rows", "shared", "own"].map((id) => [id, valueOf(id)]));
  const random = generator(Number(given.get("seed") ?? 5));
  const campaigns = Array.from({ length: CAMPAIGNS }, () => campaign(random, settings));
  const share = (which) => campaigns.filter((one) => Math.abs(one.middle) <= one[which]).length / CAMPAIGNS;
  element("numbers").innerHTML = [["byRows", "rows as independent"], ["bySetups", "by set-ups"]].map(([which, words]) => {
    const width = mean(campaigns.map((one) => one[which]));
    return `<tr><td>${words}</td>${told(share(which), `${(100 * share(which)).toFixed(0)} %`)}${told(width, `${width.toFixed(2)}″`)}</tr>`;
  }).join("");
  element("words").textContent = `The means of campaigns scatter by ${deviation(campaigns.map((one) => one.middle)).toFixed(2)}″ about the truth.`;
  const first = campaigns.slice(0, 20);
  const most = Math.max(1, ...first.map((one) => Math.abs(one.middle) + Math.max(one.byRows, one.bySetups)));
  const level = Math.ceil(most / 5) * 5;
  chart("campaigns", { x: [-level, level], y: [0, 20], xTicks: [-level, 0, level], yTicks: [], xWords: (v) => `${v}″`, title: "mean and its two intervals" }, (place) =>
    line(place, [[0, 0], [0, 20]], "var(--ink)") + first.map((one, i) => [["byRows", 0.75, "var(--before)"], ["bySetups", 0.3, "var(--after)"]].map(([which, shift, colour]) => {
      const y = 19 - i + shift;
      const [[from, at], [to], [x]] = [place([one.middle - one[which], y]), place([one.middle + one[which], y]), place([one.middle, y])];
      const contains = Math.abs(one.middle) <= one[which];
      return `<path d="M${from.toFixed(1)} ${at.toFixed(1)}H${to.toFixed(1)}" stroke="${colour}" stroke-width="2"/><circle cx="${x.toFixed(1)}" cy="${at.toFixed(1)}" r="2.5" stroke="${colour}" fill="${contains ? colour : "var(--card)"}"/>`;
    }).join("")).join(""));
}

sliders("knobs", [["setups", "set-ups", 2, 20, 1, 5, ""], ["rows", "rows in each", 2, 100, 2, 40, ""], ["shared", "error of a set-up", 0, 20, 0.5, 5, "″"], ["own", "error of a row", 0.5, 20, 0.5, 5, "″"]]);
predict(draw);
