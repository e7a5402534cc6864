// Files that a person can save. They are made here and stay here.

const types = { html: "text/html", json: "application/json" };
const blob = (name, bytes) => URL.createObjectURL(new Blob([bytes], { type: `${types[name.split(".").pop()] ?? "text/plain"};charset=utf-8` }));

/** Lists files to save: [name, bytes]. */
export function offer(list, files, isMore = false) {
  const items = files.map(([name, bytes]) => {
    const item = document.createElement("li"), link = document.createElement("a");
    link.href = blob(name, bytes);
    link.download = link.textContent = name;
    item.append(link);
    return item;
  });
  if (!isMore) {
    list.querySelectorAll("a").forEach((link) => URL.revokeObjectURL(link.href));
    list.replaceChildren();
  }
  list.append(...items);
}

/** Shows a page in a frame; gives its address. */
export function shownIn(frame, bytes) {
  if (frame.dataset.address) URL.revokeObjectURL(frame.dataset.address);
  frame.dataset.address = blob("report.html", bytes);
  frame.src = frame.dataset.address;
  return frame.dataset.address;
}
