// Colours `.bt` programs. The words are those of grammar/bt.pest: a test holds them against it.
(() => {
  const words = {
    reserved: "and behavior claim each else enum event for if in learn let not on or predicate state task tree use world",
    entries: "choose control end facing history input local observe patience place requires reward robot sensor start wall",
    lines: "after given last of otherwise per test tick when while",
    claims: "equals never probability reaches with within",
    nodes: "fail invert memory parallel repeat retry selector sequence succeed timeout",
  };
  const values = {
    truth: "false true",
    answers: "fails failure runs succeeds success",
    library: "std",
  };
  const units = {
    all: "Hz cm deg h km m min mm ms rad s ticks",
  };
  const all = (lists) => Object.values(lists).join(" ");
  // `tick` is a word as well as a unit.
  const factor = `(?:%|(?:${all(units).split(" ").join("|")}|tick)\\b)(?:\\^\\d+)?`;
  hljs.registerLanguage("bt", () => ({
    keywords: { $pattern: /[A-Za-z_]\w*/, keyword: all(words), literal: all(values) },
    contains: [
      { className: "comment", begin: "//", end: "$" },
      { className: "string", begin: '"', end: '"' },
      { className: "symbol", begin: "`", end: "`" },
      { className: "number", begin: `\\b\\d[\\d_]*(?:\\.\\d+)?(?:[eE][-+]?\\d+)?(?: ?${factor}(?:/${factor})*)?` },
      { className: "title", begin: /(?<=\b(?:world|enum|state|event|predicate|behavior|task|learn|tree|place|wall|robot|sensor)\s+)[A-Za-z_]\w*/ },
    ],
  }));
  for (const block of document.querySelectorAll("code.language-bt")) {
    hljs.highlightBlock(block);
  }
})();
