// Hover names the row, a drag marks the rows in every picture, Zoom shows only where they are, Escape or Clear forgets them; a button enlarges a
// picture. Without it the page is whole.
(() => {
  const data = JSON.parse(document.getElementById("rows").textContent);
  const count = data.rows.length;
  const tip = document.createElement("div");
  tip.id = "tip"; tip.hidden = true; tip.setAttribute("role", "status");
  document.body.append(tip);
  const state = document.getElementById("state"), clear = document.getElementById("clear"), zoom = document.getElementById("zoom");
  let marked = new Set();
  const pictures = [...document.querySelectorAll("svg.rows")].map((svg) => {
    const numbers = (name) => svg.dataset[name].split(",").map(Number);
    return { svg, over: svg.querySelector(".over"), box: numbers("box"), whole: numbers("range"), first: svg.innerHTML };
  });
  // Where each row stands in a picture that shows a range; rows outside stand nowhere.
  const put = (picture, range) => {
    const { svg, box: [left, top, width, height] } = picture, [x0, x1, y0, y1] = picture.range = range;
    const place = (name) => {
      const x = data.columns[svg.dataset.x], y = data.columns[name];
      if (!x || !y) return [];
      return Array.from({ length: count }, (_, i) => x[i] === null || y[i] === null || x[i] < x0 || x[i] > x1 || y[i] < y0 || y[i] > y1 ? null
        : [left + (x[i] - x0) / (x1 - x0) * width, top + (1 - (y[i] - y0) / (y1 - y0)) * height]);
    };
    picture.before = place(svg.dataset.before); picture.after = place(svg.dataset.after);
  };
  pictures.forEach((picture) => put(picture, picture.whole));
  const ticks = (low, high, about) => {
    const rough = (high - low) / about, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough), from = Math.ceil(low / step);
    return Array.from({ length: Math.max(0, Math.floor(high / step) - from + 1) }, (_, i) => (from + i) * step);
  };
  const told = (tick) => (Math.abs(tick) >= 1e4 && tick % 1000 === 0 ? tick / 1000 + "k" : String(+tick.toPrecision(6))).replace("-", "−");
  // The picture drawn again for the range that it shows.
  const redraw = (picture) => {
    const { svg, box: [left, top, width, height], range: [x0, x1, y0, y1] } = picture, at = (path) => svg.querySelector(path);
    if (picture.range === picture.whole) { svg.innerHTML = picture.first; picture.over = at(".over"); return; }
    const path = (points, aside, mark) => points.map((p, i) => p && !!data.aside[i] === aside ? mark(p[0].toFixed(1), +p[1].toFixed(1)) : "").join("");
    at(".tri")?.setAttribute("d", path(picture.before, false, (x, y) => `M${x} ${y - 3}l3 5h-6z`));
    at(".dot")?.setAttribute("d", path(picture.after, false, (x, y) => `M${x} ${y}h0`));
    at(".cross")?.setAttribute("d", path(picture.after, true, (x, y) => `M${x - 3} ${y - 3}l6 6m0-6l-6 6`));
    // Curves and means keep their numbers and move with the range, cut at the edge of the picture.
    const [u0, u1, v0, v1] = picture.whole, across = (u1 - u0) / (x1 - x0), up = (v1 - v0) / (y1 - y0), plot = at(".plot");
    const right = left - left * across + (u0 - x0) / (x1 - x0) * width, down = top - top * up - (v1 - y1) / (y1 - y0) * height;
    plot.querySelectorAll(".curve, .band, .normal, .dia").forEach((line) => {
      line.setAttribute("transform", `matrix(${across} 0 0 ${up} ${right} ${down})`); line.setAttribute("vector-effect", "non-scaling-stroke");
    });
    const id = `cut${pictures.indexOf(picture)}`;
    plot.insertAdjacentHTML("afterbegin", `<clipPath id="${id}"><path d="M${left} ${top}h${width}v${height}h${-width}z"/></clipPath>`);
    plot.setAttribute("clip-path", `url(#${id})`);
    const labels = [...svg.querySelectorAll(".axes .label")].map((label) => label.outerHTML).join(""), bottom = top + height;
    at(".axes").innerHTML = ticks(x0, x1, Math.max(3, Math.min(9, (left + width) / 75))).map((t) => {
      const x = (left + (t - x0) / (x1 - x0) * width).toFixed(1);
      return `<path class="grid" d="M${x} ${top}V${bottom}"/><text x="${x}" y="${bottom + 13}" text-anchor="middle">${told(t)}</text>`;
    }).join("") + ticks(y0, y1, 5).map((t) => {
      const y = (top + (1 - (t - y0) / (y1 - y0)) * height).toFixed(1);
      return `<path class="grid" d="M${left} ${y}h${width}"/><text x="${left - 5}" y="${+y + 4}" text-anchor="end">${told(t)}</text>`;
    }).join("") + (y0 < 0 && y1 > 0 ? `<path class="zero" d="M${left} ${(top + y1 / (y1 - y0) * height).toFixed(1)}h${width}"/>` : "") + labels;
  };
  const range = (picture) => {
    const x = data.columns[picture.svg.dataset.x], [x0, x1, y0, y1] = picture.whole;
    const which = document.querySelector("input[name=show]:checked")?.id;
    const names = [which === "show-after" ? null : picture.svg.dataset.before, which === "show-before" ? null : picture.svg.dataset.after];
    const xs = [], ys = [];
    for (const name of names) for (const i of marked) {
      const y = data.columns[name]?.[i];
      if (x?.[i] != null && y != null) { xs.push(x[i]); ys.push(y); }
    }
    if (xs.length < 2) return picture.whole;
    const around = (values, all) => {
      const low = Math.min(...values), high = Math.max(...values), room = 0.08 * (high - low) || 0.02 * all;
      return [low - room, high + room];
    };
    return [...around(xs, x1 - x0), ...around(ys, y1 - y0)];
  };
  const shown = (picture) => {
    const which = document.querySelector("input[name=show]:checked")?.id;
    return [which === "show-after" ? [] : picture.before, which === "show-before" ? [] : picture.after];
  };
  const draw = () => {
    for (const picture of pictures) {
      let path = "";
      for (const points of shown(picture)) for (const i of marked) {
        const p = points[i];
        if (p) path += `M${(p[0] - 3).toFixed(1)} ${(p[1] - 3).toFixed(1)}h6v6h-6z`;
      }
      picture.over.innerHTML = path ? `<path class="marked" d="${path}"/>` : "";
    }
    const of = data.of > count ? ` drawn rows (of ${data.of})` : " rows";
    const rms = (key) => {
      const squares = [...marked].map((i) => data[key][i]).filter((v) => v !== null).map((v) => v * v);
      return squares.length ? (Math.sqrt(squares.reduce((a, b) => a + b, 0) / squares.length)).toPrecision(3) + data.unit : "–";
    };
    state.textContent = marked.size ? `${marked.size} of ${count}${of} marked: ${rms("before")} before, ${rms("after")} after (RMS)` : "Drag over a picture to mark rows in all.";
    clear.hidden = !marked.size; zoom.hidden = marked.size < 2;
  };
  let zoomed = false;
  const look = (closer) => {
    zoomed = closer;
    zoom.textContent = closer ? "Show all again" : "Zoom to them";
    for (const picture of pictures) { put(picture, closer ? range(picture) : picture.whole); redraw(picture); }
    draw();
  };
  zoom.addEventListener("click", () => look(!zoomed));
  const local = (svg, event) => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [point.x, point.y];
  };
  for (const picture of pictures) {
    let from = null;
    picture.svg.addEventListener("pointermove", (event) => {
      const [x, y] = local(picture.svg, event);
      if (from) {
        const [l, t, w, h] = [Math.min(x, from[0]), Math.min(y, from[1]), Math.abs(x - from[0]), Math.abs(y - from[1])];
        picture.over.innerHTML = `<path class="brush" d="M${l} ${t}h${w}v${h}h${-w}z"/>`;
        return;
      }
      let best = 12 * 12, row = -1;
      for (const points of shown(picture)) points.forEach((p, i) => {
        const d = p ? (p[0] - x) ** 2 + (p[1] - y) ** 2 : Infinity;
        if (d < best) { best = d; row = i; }
      });
      tip.hidden = row < 0;
      if (row < 0) return;
      const names = data.readings.map((name) => `${name} ${data.columns[name][row]}`).join(", ");
      tip.textContent = `Row ${data.rows[row]}${data.aside[row] ? " (outlier)" : ""}: ${names}, residual ${data.before[row]}${data.unit} before, ${data.after[row]}${data.unit} after`;
      tip.style.left = Math.max(4, Math.min(event.clientX + 14, innerWidth - 270)) + "px";
      tip.style.top = Math.max(4, Math.min(event.clientY + 14, innerHeight - tip.offsetHeight - 8)) + "px";
    });
    picture.svg.addEventListener("pointerleave", () => { if (!from) tip.hidden = true; });
    picture.svg.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "touch") return;
      from = local(picture.svg, event); tip.hidden = true;
      picture.svg.setPointerCapture(event.pointerId); event.preventDefault();
    });
    picture.svg.addEventListener("pointerup", (event) => {
      if (!from) return;
      const to = local(picture.svg, event);
      const [l, r] = [from[0], to[0]].sort((a, b) => a - b), [t, b] = [from[1], to[1]].sort((a, b) => a - b);
      from = null; marked = new Set();
      for (const points of shown(picture)) points.forEach((p, i) => {
        if (p && p[0] >= l && p[0] <= r && p[1] >= t && p[1] <= b) marked.add(i);
      });
      draw();
    });
  }
  document.querySelectorAll("#residuals .card > svg, #left .card > svg").forEach((svg) => {
    const card = svg.parentElement, grow = document.createElement("button");
    if (card.classList.contains("wide")) return;
    grow.type = "button"; grow.className = "grow"; grow.textContent = "Enlarge";
    grow.setAttribute("aria-pressed", "false");
    grow.setAttribute("aria-label", `Enlarge: ${card.querySelector("h3")?.textContent ?? "picture"}`);
    grow.addEventListener("click", () => grow.setAttribute("aria-pressed", String(card.classList.toggle("wide"))));
    card.prepend(grow);
  });
  const forget = () => { marked = new Set(); look(false); };
  clear.addEventListener("click", forget);
  addEventListener("keydown", (event) => { if (event.key === "Escape") forget(); });
  document.querySelectorAll("input[name=show]").forEach((input) => input.addEventListener("change", draw));
  document.querySelectorAll("pre.copy").forEach((pre) => {
    const button = document.createElement("button");
    button.textContent = "Copy"; button.type = "button";
    button.addEventListener("click", () => navigator.clipboard?.writeText(pre.textContent).then(() => { button.textContent = "Copied"; }));
    pre.after(button);
  });
  draw();
})();
