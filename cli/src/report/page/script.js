// Hover names the row, a drag marks the rows in every picture, Escape or Clear forgets them; a button enlarges a picture. Without it the page is whole.
(() => {
  const data = JSON.parse(document.getElementById("rows").textContent);
  const count = data.rows.length;
  const tip = document.createElement("div");
  tip.id = "tip"; tip.hidden = true; tip.setAttribute("role", "status");
  document.body.append(tip);
  const state = document.getElementById("state"), clear = document.getElementById("clear");
  let marked = new Set();
  const pictures = [...document.querySelectorAll("svg.rows")].map((svg) => {
    const [left, top, width, height] = svg.dataset.box.split(",").map(Number);
    const [x0, x1, y0, y1] = svg.dataset.range.split(",").map(Number);
    const place = (name) => {
      const x = data.columns[svg.dataset.x], y = data.columns[name];
      if (!x || !y) return [];
      return Array.from({ length: count }, (_, i) => x[i] === null || y[i] === null ? null
        : [left + (x[i] - x0) / (x1 - x0) * width, top + (1 - (y[i] - y0) / (y1 - y0)) * height]);
    };
    return { svg, over: svg.querySelector(".over"), before: place(svg.dataset.before), after: place(svg.dataset.after) };
  });
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
    clear.hidden = !marked.size;
  };
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
      tip.textContent = `Row ${data.rows[row]}${data.aside[row] ? ", set aside" : ""}: ${names}; residual ${data.before[row]}${data.unit} before, ${data.after[row]}${data.unit} after`;
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
  document.querySelectorAll(".grid > .card > svg").forEach((svg) => {
    const card = svg.parentElement, grow = document.createElement("button");
    if (card.classList.contains("wide")) return;
    grow.type = "button"; grow.className = "grow"; grow.textContent = "Enlarge";
    grow.setAttribute("aria-pressed", "false");
    grow.setAttribute("aria-label", `Enlarge: ${card.querySelector("h3")?.textContent ?? "picture"}`);
    grow.addEventListener("click", () => grow.setAttribute("aria-pressed", String(card.classList.toggle("wide"))));
    card.prepend(grow);
  });
  const forget = () => { marked = new Set(); draw(); };
  clear.addEventListener("click", forget);
  addEventListener("keydown", (event) => { if (event.key === "Escape") forget(); });
  document.querySelectorAll("input[name=show]").forEach((input) => input.addEventListener("change", draw));
  document.querySelectorAll("pre.copy").forEach((pre) => {
    const button = document.createElement("button");
    button.textContent = "Copy"; button.type = "button";
    button.addEventListener("click", () => navigator.clipboard?.writeText(pre.textContent).then(() => { button.textContent = "Copied"; }));
    pre.after(button);
  });
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((d) => { d.open = true; }));
  draw();
})();
