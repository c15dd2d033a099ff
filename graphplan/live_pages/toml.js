/** Tables as TOML: plain keys first, then tables and lists of tables. */
function written(table, above = "") {
  const key = (name) => (/^[\w-]+$/.test(name) ? name : JSON.stringify(name));
  const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
  const isList = (value) => Array.isArray(value) && value.length > 0 && value.every(isTable);
  const inline = (value) => {
    if (Array.isArray(value)) return `[${value.map(inline).join(", ")}]`;
    if (isTable(value)) return `{ ${Object.entries(value).map(([name, part]) => `${key(name)} = ${inline(part)}`).join(", ")} }`;
    return JSON.stringify(value);
  };
  const entries = Object.entries(table), whole = (value) => !above && (isTable(value) || isList(value));
  let text = entries.filter(([, value]) => !whole(value)).map(([name, value]) => `${key(name)} = ${inline(value)}\n`).join("");
  for (const [name, value] of entries.filter(([, value]) => whole(value))) {
    const head = isList(value) ? `[[${key(name)}]]` : `[${key(name)}]`;
    for (const part of isList(value) ? value : [value]) text += `\n${head}\n${written(part, name)}`;
  }
  return text;
}
