// Writes the TextMate grammar. Names, numbers with units and blocks are written once here; lists of words that the
// language may grow (units, nodes of trees) are read from the language's own grammar.
import { readFileSync, mkdirSync, writeFileSync } from "node:fs";
import { pestWords } from "./words.mjs";

const raw = String.raw;
const pest = readFileSync(new URL("../../grammar/bt.pest", import.meta.url), "utf8");
const alternatives = (rule) => pestWords(pest, rule).sort((a, b) => b.length - a.length).join("|");

const NAME = raw`(?:[A-Za-z_]\w*|${"`"}[^${"`"}\n]+${"`"})`;
const TYPE = raw`${NAME}(?:\s*[*/]\s*${NAME})*`;
const FACTOR = raw`(?:%|(?:${alternatives("factor_name")})\b)(?:\^\d+)?`;
const UNIT = raw`(?:${FACTOR})(?:/(?:${FACTOR}))*`;
const NUMBER = raw`0[xX][0-9A-Fa-f]+|(?:\d[\d_]*(?:\.(?!\.)[\d_]*)?|\.\d+)(?:[eE][-+]?\d+)?`;
const ARGUMENTS = raw`(?:\s*\((?:[^()\n]|\([^()\n]*\))*\))?`;
/** A word that is given a value is a name, whatever it is elsewhere. */
const NO_NAME = raw`(?!\s*(?:[-+*/]?=(?![=>])|:=))`;
/** Something that has a value follows on the line. */
const VALUE = raw`(?=[ \t]+[-\w("${"`"}.])`;
/** Between what has a value and what follows it. */
const INFIX = raw`(?:^\s*|(?<=[\w)${"`"}%])[ \t]+)`;
/** Where an entry of a block can begin. */
const ENTRY = raw`(?:^|(?<=[{}]))\s*`;
/** A new item at the margin ends all blocks whose `}` is missing. */
const ITEM = raw`^(?=(?:world|enum|state|event|predicate|behavior|task|learn|tree|claim)\s+[A-Za-z_${"`"}]|use\s+(?:std\b|")|test\s+["“]|each\s+tick\b|input\s+${NAME}\s*:)`;

const scoped = (scope) => `${scope}.behaviortree`;

/** Captures by their order; what is not a string is a list of patterns. */
function captures(scopes) {
  const entries = scopes.map((scope, i) => [i + 1, typeof scope === "string" ? { name: scoped(scope) } : scope]);
  return Object.fromEntries(entries.filter(([, scope]) => scope !== null));
}

const word = (match, scope) => ({ match, name: scoped(scope) });
const parts = (match, ...scopes) => ({ match, captures: captures(scopes) });
const rules = (...names) => names.map((name) => ({ include: `#${name}` }));

/** A name that is declared, with or without backquotes. */
const declared = (scope) => ({
  patterns: [
    { match: "`[^`\\n]+`", name: `${scoped(scope)} ${scoped("string.other.quoted-name")}` },
    { match: ".+", name: scoped(scope) },
  ],
});

/** From what `begin` finds, whose last group is `{`, to the `}`. */
function block(name, begin, scopes, patterns) {
  return {
    name: scoped(`meta.${name}`),
    begin,
    beginCaptures: captures([...scopes, "punctuation.section.block.begin"]),
    end: raw`\}|${ITEM}`,
    endCaptures: { 0: { name: scoped("punctuation.section.block.end") } },
    patterns,
  };
}

/** `state battery: ratio = …`, up to the `=`. */
function declaration(kind, scope, before = raw`\b`) {
  return {
    name: scoped(`meta.declaration.${kind}`),
    begin: raw`${before}(${kind})\s+(${NAME})`,
    beginCaptures: captures([`storage.type.${kind}`, declared(scope)]),
    end: raw`(?=[={}]|//)|$`,
    patterns: [...rules("parens"), parts(raw`(:)\s*(${TYPE})`, "punctuation.separator.colon", "entity.name.type")],
  };
}

const variants = [
  ...rules("comments"),
  word(NAME, "variable.other.enummember"),
  word(",", "punctuation.separator.comma"),
];

/** `place A: kind`, `wall w: kind`, `sensor s` */
const placed = (kind) =>
  parts(raw`\b(${kind})\s+(${NAME})(?:\s*(:)\s*(${NAME}))?(?=\s*=)`, `storage.type.${kind}`,
    declared(`variable.other.constant.${kind}`), "punctuation.separator.colon", "entity.name.type.kind");

const repository = {
  comments: {
    patterns: [
      { ...parts(raw`(//!).*$`, "punctuation.definition.comment"), name: scoped("comment.line.documentation") },
      { ...parts(raw`(///)(?!/).*$`, "punctuation.definition.comment"), name: scoped("comment.line.documentation") },
      { ...parts(raw`(//).*$`, "punctuation.definition.comment"), name: scoped("comment.line.double-slash") },
    ],
  },
  strings: {
    patterns: [{
      name: scoped("string.quoted.double"),
      begin: '["“]',
      beginCaptures: { 0: { name: scoped("punctuation.definition.string.begin") } },
      end: '["”]|$',
      endCaptures: { 0: { name: scoped("punctuation.definition.string.end") } },
    }],
  },
  "quoted-names": {
    patterns: [{
      ...parts("(`)[^`\\n]+(`)", "punctuation.definition.name.begin", "punctuation.definition.name.end"),
      name: scoped("variable.other.quoted-name"),
    }],
  },
  numbers: {
    patterns: [parts(raw`(?<![\w.])(${NUMBER})(?:[ \t]*(${UNIT})${NO_NAME})?`, "constant.numeric", "keyword.other.unit")],
  },
  operators: {
    patterns: [
      word("=>|⇒", "keyword.operator.guard"),
      word("->|→", "keyword.operator.link"),
      word("==|!=|<=|>=|<|>|≤|≥|≠", "keyword.operator.comparison"),
      word("[-+*/]?=", "keyword.operator.assignment"),
      word(raw`\.\.`, "keyword.operator.range"),
      word(raw`\*\*|[-+*/^]`, "keyword.operator.arithmetic"),
      word(raw`\b(?:and|or|not)\b`, "keyword.operator.logical"),
      word(raw`${INFIX}is(?:[ \t]+not)?\b${NO_NAME}(?!\()`, "keyword.operator.comparison"),
      parts(raw`${INFIX}(of|per)\b${NO_NAME}${VALUE}`, "keyword.operator.$1"),
    ],
  },
  control: { patterns: [word(raw`\b(?:if|else)\b`, "keyword.control.conditional"), word(raw`\b(?:for|in)\b`, "keyword.control.loop")] },
  constants: { patterns: [word(raw`\b(?:true|false)\b`, "constant.language.boolean")] },
  calls: {
    patterns: [
      parts(raw`\b(drive)(?=\()`, "support.function.drive"),
      parts(raw`([A-Za-z_]\w*|${"`"}[^${"`"}\n]+${"`"})(?=[ \t]*\()`, "entity.name.function.call"),
    ],
  },
  parens: {
    begin: raw`\(`,
    beginCaptures: { 0: { name: scoped("punctuation.section.parens.begin") } },
    end: raw`\)|(?=\})|${ITEM}`,
    endCaptures: { 0: { name: scoped("punctuation.section.parens.end") } },
    patterns: [
      parts(raw`(?:^\s*|(?<=[(,])\s*)(${NAME})[ \t]*(=)(?![=>])`, "variable.parameter", "keyword.operator.assignment"),
      parts(raw`(?:^\s*|(?<=[(,])\s*)(${NAME})\s*(:)(?!=)\s*(${TYPE})`, "variable.parameter", "punctuation.separator.colon", "entity.name.type"),
      ...rules("expression"),
    ],
  },
  braces: block("block", raw`(\{)`, [], rules("let", "for", "expression")),
  for: { patterns: [parts(raw`\b(for)\s+(${NAME})\s+(in)\b`, "keyword.control.loop", "variable.parameter", "keyword.control.loop")] },
  let: declaration("let", "variable.other.constant"),
  expression: {
    patterns: [
      ...rules("comments", "strings", "numbers", "control", "constants", "calls", "quoted-names", "operators", "parens", "braces"),
      word(",", "punctuation.separator.comma"),
      word(":", "punctuation.separator.colon"),
    ],
  },
  setting: { patterns: [parts(raw`${ENTRY}(${NAME})\s*(=)(?![=>])`, "variable.other.property", "keyword.operator.assignment")] },

  use: {
    patterns: [
      parts(raw`\b(use)\s+(std)\b`, "keyword.control.import", "support.module"),
      {
        begin: raw`\b(use)(?=\s+["“])`,
        beginCaptures: captures(["keyword.control.import"]),
        end: "$",
        patterns: [
          ...rules("strings", "comments"),
          parts(raw`\b(sha256)(:)([0-9a-fA-F]{64})\b`, "keyword.other.pin", "punctuation.separator.colon", "constant.other.hash"),
        ],
      },
    ],
  },
  world: block("world", raw`\b(world)\s+(${NAME})\s*(\{)`, ["storage.type.world", declared("entity.name.type.world")], [
    ...rules("robot"),
    placed("place"),
    placed("wall"),
    parts(raw`${INFIX}(facing)\b${NO_NAME}${VALUE}`, "keyword.other.facing"),
    parts(raw`${INFIX}(when)\b${NO_NAME}${VALUE}`, "keyword.control.when"),
    ...rules("setting", "expression"),
  ]),
  robot: block("robot", raw`\b(robot)\s+(${NAME})\s*(\{)`, ["storage.type.robot", declared("entity.name.type.robot")], [
    placed("sensor"),
    ...rules("setting", "expression"),
  ]),
  enum: block("enum", raw`\b(enum)\s+(${NAME})\s*(\{)`, ["storage.type.enum", declared("entity.name.type.enum")], variants),
  input: {
    patterns: [
      block("declaration.input", raw`\b(input)\s+(${NAME})\s*(:)\s*(\{)`,
        ["storage.type.input", declared("variable.other.input"), "punctuation.separator.colon"], variants),
      parts(raw`^\s*(input)\s+(${NAME})\s*(:)\s*(${TYPE})`, "storage.type.input", declared("variable.other.input"),
        "punctuation.separator.colon", "entity.name.type"),
    ],
  },
  state: declaration("state", "variable.other.state"),
  event: declaration("event", "variable.other.event"),
  predicate: declaration("predicate", "entity.name.function.predicate"),
  "each-tick": { patterns: [parts(raw`\b(each)\s+(tick)\b`, "keyword.control.each", "keyword.control.tick")] },
  on: { patterns: [parts(raw`^\s*(on)\b`, "keyword.control.on")] },
  behavior: {
    patterns: [
      block("behavior", raw`\b(behavior)\s+(${NAME})(${ARGUMENTS})\s*(\{)`,
        ["storage.type.behavior", declared("entity.name.function.behavior"), { patterns: rules("parens") }], [
          parts(raw`${ENTRY}(local)\s+(${NAME})(?:\s*(:)\s*(${TYPE}))?`, "storage.type.local", declared("variable.other.local"),
            "punctuation.separator.colon", "entity.name.type"),
          parts(raw`\b(requires)\b${NO_NAME}${VALUE}`, "keyword.control.requires"),
          parts(raw`\b(succeed|fail)\s+(when)\b`, "keyword.control.$1", "keyword.control.when"),
          parts(raw`\b(control)(?=\s*\{)`, "keyword.control.control"),
          ...rules("expression"),
        ]),
      declaration("behavior", "entity.name.function.behavior"),
    ],
  },
  task: block("task", raw`\b(task)\s+(${NAME})\s*(\{)`, ["storage.type.task", declared("entity.name.type.task")], [
    ...rules("start", "reward"),
    parts(raw`${ENTRY}(observe|choose)\b${NO_NAME}(?!\s*\()`, "keyword.other.$1"),
    parts(raw`${ENTRY}(history)\s+(last)\b`, "keyword.other.history", "keyword.other.last"),
    parts(raw`${ENTRY}(patience)\b${NO_NAME}${VALUE}`, "keyword.other.patience"),
    parts(raw`${ENTRY}(end)\s+(on|after)\b`, "keyword.control.end", "keyword.control.$2"),
    word(raw`\b(?:${alternatives("outcome")})\b(?!\s*\()${NO_NAME}`, "constant.language.outcome"),
    ...rules("expression"),
  ]),
  start: block("start", raw`\b(start)\s*(\{)`, ["keyword.other.start"], [
    parts(raw`${ENTRY}(${NAME})(?=\s*(?:\([^()\n]*\)\s*)?=(?![=>]))`, "variable.other.property"),
    ...rules("expression"),
  ]),
  reward: block("reward", raw`\b(reward)\s*(\{)`, ["keyword.other.reward"], [
    parts(raw`${ENTRY}(on|while|otherwise)\b`, "keyword.control.$1"),
    parts(raw`(?:^|(?<=[{},]))\s*(per)\b${VALUE}`, "keyword.control.per"),
    ...rules("expression"),
  ]),
  learn: {
    patterns: [
      block("learn", raw`\b(learn)\s+(${NAME})\s+(for)\s+(${NAME})\s*(\{)`,
        ["storage.type.learn", declared("entity.name.function.learner"), "keyword.other.for", "entity.name.type.task"], rules("start", "setting", "expression")),
      block("learn", raw`\b(learn)\s+(${NAME})\s*(\{)`, ["storage.type.learn", "entity.name.type.task"], rules("start", "setting", "expression")),
    ],
  },
  tree: {
    name: scoped("meta.tree"),
    begin: raw`\b(tree)\s+(${NAME})`,
    beginCaptures: captures(["storage.type.tree", declared("entity.name.function.tree")]),
    end: raw`(?<=\})|(?=\})|${ITEM}|^(?=(?:on|let)\b)|^\s*$`,
    patterns: [
      parts(raw`(?<=[\w)${"`"}])\s+(for)\s+(${NAME})(?=\s*=)`, "keyword.other.for", "entity.name.type.task"),
      ...rules("nodes", "children", "expression"),
    ],
  },
  nodes: {
    patterns: [
      parts(raw`\b(memory)(?=\s+[A-Za-z_]\w*${ARGUMENTS}\s*\{)`, "storage.modifier.memory"),
      parts(raw`\b(${alternatives("known_word")})(?=${ARGUMENTS}\s*\{)`, "keyword.control.node.$1"),
    ],
  },
  children: block("children", raw`(\{)`, [], rules("nodes", "children", "expression")),
  claim: {
    name: scoped("meta.claim"),
    begin: raw`\b(claim)\s+(${NAME})`,
    beginCaptures: captures(["storage.type.claim", declared("entity.name.function.tree")]),
    end: "$|(?=//)",
    patterns: [
      parts(raw`\b(equals)\s+(${NAME})`, "keyword.other.equals", "entity.name.function.tree"),
      parts(raw`\b(never|reaches|within)\b${VALUE}`, "keyword.other.$1"),
      parts(raw`\b(with)\s+(probability)\b`, "keyword.other.with", "keyword.other.probability"),
      ...rules("expression"),
    ],
  },
  test: block("test", raw`\b(test)\s+(["“][^"”\n]*["”])\s+(of)\s+(${NAME})(${ARGUMENTS})\s*(\{)`,
    ["storage.type.test", "string.quoted.double", "keyword.other.of", "entity.name.function.tree", { patterns: rules("parens") }], [
      parts(raw`${ENTRY}(given|tick)\b${NO_NAME}`, "keyword.other.$1"),
      parts(raw`(?<=[\w)${"`"}])[ \t]+(${alternatives("answer")})\b`, "constant.language.answer"),
      ...rules("expression"),
    ]),
};

const items = ["test", "use", "world", "enum", "input", "state", "event", "each-tick", "on", "let", "predicate", "behavior", "task", "learn", "tree", "claim"];
const grammar = {
  name: "Behaviour tree",
  scopeName: "source.behaviortree",
  fileTypes: ["bt"],
  patterns: rules("comments", ...items, "for", "expression"),
  repository,
};

const folder = new URL("syntaxes/", import.meta.url);
mkdirSync(folder, { recursive: true });
writeFileSync(new URL("behaviortree.tmLanguage.json", folder), JSON.stringify(grammar, null, 2) + "\n");
