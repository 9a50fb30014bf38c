// The words of the language, as its own grammar has them.

/** The words in a rule, in their order: `kw_task = @{ "task" ~ !name_char }` has `task`. */
export function pestWords(pest, rule) {
  const start = new RegExp(`^${rule}\\s*=\\s*[@$_!]?\\{`, "m").exec(pest);
  if (start === null) {
    throw new Error(`the grammar has no rule ${rule}`);
  }
  let depth = 1;
  let end = start.index + start[0].length;
  const text = pest.replace(/"(?:\\.|[^"\\])*"/g, (string) => string.replace(/[{}]/g, " "));
  for (; depth > 0; end += 1) {
    depth += { "{": 1, "}": -1 }[text[end]] ?? 0;
  }
  const body = text.slice(start.index + start[0].length, end);
  return [...body.matchAll(/"([A-Za-z][A-Za-z0-9]*)"/g)].map(([, word]) => word);
}

/** The rules of the grammar that stand for a right program and are nothing but words. */
export function wordRules(pest) {
  const names = [...pest.matchAll(/^(\w+)\s*=/gm)].map(([, name]) => name);
  const others = ["reserved", "known_word", "boolean", "std", "outcome", "answer", "factor_name", "or_op", "and_op", "not_op", "link"];
  return names.filter((name) => name.startsWith("kw_") || others.includes(name));
}
