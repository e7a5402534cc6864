// Sets "cos α sin β" apart: the invisible operator between a function's name and its argument has no width of its own in browsers, where print has
// a thin space. Without a script the formulas only stand closer.
for (const apply of document.querySelectorAll("math mo")) {
  if (apply.textContent !== "\u2061") continue;
  const name = apply.previousElementSibling, argument = apply.nextElementSibling, before = name?.previousElementSibling;
  if (argument && !/^[([{]/.test(argument.textContent)) apply.setAttribute("rspace", "0.167em");
  if (before && (before.localName !== "mo" || /^[)\]}]$/.test(before.textContent))) {
    const space = document.createElementNS(apply.namespaceURI, "mspace");
    space.setAttribute("width", "0.167em");
    name.before(space);
  }
}
// Links to `README.md` are written as `README.html`, which only leads on to `index.html`: with a script they go there at once, to the heading they name.
for (const link of document.querySelectorAll('a[href*="README.html"]')) link.setAttribute("href", link.getAttribute("href").replace("README.html", "index.html"));
