// Looks at the page as it is laid out, and writes what it finds into the page. Folded tables are opened first.
addEventListener("load", () => {
  document.querySelectorAll("details").forEach((d) => { d.open = true; });

  // The boxes of all pieces of text, line by line.
  const boxes = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.data.trim() || parent.closest("script, style, pre#inspection, title, desc")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    // Parts of one label or formula (a subscript) may touch each other.
    const label = parent.closest("text, math") || node;
    const text = (label.textContent || "").trim();
    if (parent.closest("svg")) {
      const r = (parent.closest("text") || parent).getBoundingClientRect();
      boxes.push({ label, text, svg: parent.closest("svg"), turned: /rotate/.test(parent.closest("text")?.getAttribute("transform") || ""), r });
    } else {
      for (const r of range.getClientRects()) boxes.push({ label, text, svg: null, r });
    }
  }
  boxes.sort((a, b) => a.r.top - b.r.top);

  // The box of a line is higher than its letters: what is shared must be more than that margin.
  const slack = 3;
  const shared = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5
    && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > slack;
  const overlaps = new Set();
  boxes.forEach((one, index) => {
    for (let next = index + 1; next < boxes.length && boxes[next].r.top < one.r.bottom; next += 1) {
      const other = boxes[next];
      if (one.label !== other.label && shared(one.r, other.r)) overlaps.add(`${one.text} / ${other.text}`);
    }
  });

  // Text of a drawing that reaches beyond it is cut off.
  const cut = boxes.filter(({ svg, r }) => {
    if (!svg) return false;
    const s = svg.getBoundingClientRect();
    return r.left < s.left - 1 || r.right > s.right + 1 || r.top < s.top - slack || r.bottom > s.bottom + slack;
  }).map(({ text }) => text);

  const figures = [...document.querySelectorAll("figure")].map((figure) => {
    const svg = figure.querySelector("svg");
    const r = svg ? svg.getBoundingClientRect() : { width: 0, height: 0 };
    const count = (what) => (svg ? svg.querySelectorAll(what).length : 0);
    return { id: figure.id, width: r.width, height: r.height, shapes: count("path, line, circle, rect, polygon, polyline"), texts: count("text") };
  });
  const fetched = performance.getEntriesByType("resource").map((entry) => entry.name);
  const sideways = document.documentElement.scrollWidth > document.documentElement.clientWidth + 1;
  const small = boxes.filter(({ svg, r }) => svg && r.height > 0 && r.height < 8).map(({ text }) => text);
  const shown = [...document.querySelectorAll(".claims li")].filter((item) => item.getBoundingClientRect().height > 0).length;
  const result = document.createElement("pre");
  result.id = "inspection";
  result.textContent = JSON.stringify({ figures, fetched, overlaps: [...overlaps], cut, sideways, small, shown });
  document.body.append(result);
});
