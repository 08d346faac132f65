// Functions that the pages of the charts share.
const by = id => document.getElementById(id);
const unique = list => [...new Set(list)];
const number = (v, digits = 3) => v == null ? "-" : v === 0 ? "0" :
  Math.abs(v) >= 1e3 && Math.abs(v) < 1e9 ? Math.round(v).toLocaleString("en") : String(+v.toPrecision(digits));

function fill(select, names, chosen) {
  select.replaceChildren(...names.map(name => new Option(name, name, false, name === chosen)));
}

function table(into, head, rows) {
  const line = (cells, tag) => {
    const tr = document.createElement("tr");
    for (const cell of cells) {
      const td = document.createElement(tag);
      td.textContent = cell;
      if (String(cell).length > 24) td.className = "text";
      tr.append(td);
    }
    return tr;
  };
  into.replaceChildren(line(head, "th"), ...rows.map(r => line(r, "td")));
}
