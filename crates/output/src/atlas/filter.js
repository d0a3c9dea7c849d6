
const rows = [...document.querySelectorAll("#matrix-table tbody tr")];
const [code, property, all] = ["code", "property", "all"].map((id) => document.getElementById(id));
const show = () => {
  const words = code.value.toLowerCase().split(/\s+/).filter(Boolean);
  rows.forEach((row) => {
    const text = [...row.cells].slice(0, 3).map((cell) => cell.textContent).join(" ").toLowerCase();
    row.hidden = !(all.checked || row.dataset.latest === "true") || !words.every((word) => text.includes(word));
  });
  document.querySelectorAll("#matrix-table [data-column]").forEach((cell) => {
    cell.hidden = property.value !== "" && cell.dataset.column !== property.value;
  });
};
[code, property, all].forEach((input) => input.addEventListener("input", show));
show();
