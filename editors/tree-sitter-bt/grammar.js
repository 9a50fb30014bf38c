// The language of btc, as `grammar/bt.pest` has it, without what that says of mistakes.
/// <reference types="tree-sitter-cli/dsl" />
// @ts-check

const PREC = { range: 1, or: 2, and: 3, not: 4, compare: 5, sum: 6, term: 7, sign: 8, power: 9, coordinate: 10 };

/** One or more, with commas between them and maybe one after them. */
const list = (rule) => seq(rule, repeat(seq(",", rule)), optional(","));
const block = (...entries) => seq("{", repeat(choice(...entries)), "}");
const value = ($) => seq("=", field("value", $._expression));
const typed = ($) => seq(":", field("type", $.type));

module.exports = grammar({
  name: "behaviortree",

  externals: ($) => [$.unit],
  extras: ($) => [/[\s\uFEFF]/, $.comment, $.doc_comment],
  word: ($) => $.identifier,
  supertypes: ($) => [$._item, $._expression, $._node],

  rules: {
    file: ($) => repeat($._item),

    _item: ($) =>
      choice(
        $.use, $.world, $.enum, $.input, $.state, $.event, $.each_tick, $.on, $.let, $.predicate, $.behavior, $.task,
        $.learn, $.tree, $.claim, $.test,
      ),

    // ---- items

    use: ($) => seq("use", choice("std", seq(field("path", $.string), optional(field("pin", $.pin))))),
    enum: ($) => seq("enum", field("name", $._name), $.variants),
    variants: ($) => seq("{", optional(list($._name)), "}"),
    input: ($) => seq("input", field("name", $._name), ":", field("type", choice($.type, $.variants))),
    state: ($) => seq("state", field("name", $._name), optional($.parameters), optional(typed($)), value($)),
    event: ($) => seq("event", field("name", $._name), optional($.parameters), value($)),
    each_tick: ($) => seq("each", "tick", field("body", $.block)),
    on: ($) => seq("on", field("event", choice($._expression, $.family)), field("body", $.block)),
    family: ($) => seq(field("name", $._name), alias($._given_parameters, $.parameters)),
    let: ($) =>
      seq("let", field("name", $._name), optional($.parameters), optional(typed($)), "=", field("value", choice($._expression, $.yield))),
    predicate: ($) => seq("predicate", field("name", $._name), optional($.parameters), optional(value($))),

    // ---- the world

    world: ($) => seq("world", field("name", $._name), block($.place, $.wall, $.robot, $.setting)),
    place: ($) => seq("place", field("name", $._name), optional($._kind), value($), optional(seq("facing", field("facing", $._expression)))),
    wall: ($) => seq("wall", field("name", $._name), optional($._kind), value($), optional(seq("when", field("when", $._expression)))),
    _kind: ($) => seq(":", field("kind", $._name)),
    robot: ($) => seq("robot", field("name", $._name), block($.sensor, $.setting)),
    sensor: ($) => seq("sensor", field("name", $._name), value($)),
    setting: ($) => seq(field("name", $._name), value($), optional(seq(choice("of", "per", "->", "→"), field("of", $._expression)))),

    // ---- behaviours

    behavior: ($) =>
      seq("behavior", field("name", $._name), optional($.parameters), optional(choice($._clauses, seq("=", field("value", $.reference))))),
    _clauses: ($) => block($.local, $.requires, $.succeed, $.fail, $.control),
    local: ($) => seq("local", field("name", $._name), optional(typed($)), value($)),
    requires: ($) => seq("requires", $._expression),
    succeed: ($) => seq("succeed", "when", $._expression),
    fail: ($) => seq("fail", "when", $._expression),
    control: ($) => seq("control", field("body", $.block)),

    // ---- tasks and learners

    task: ($) =>
      seq("task", field("name", $._name), block($.observe, $.choose, $.history, $.patience, $.start, $.end, $.reward)),
    observe: ($) => seq("observe", list($._expression)),
    choose: ($) => seq("choose", list($._expression)),
    history: ($) => seq("history", "last", $.number, $.outcome, repeat(seq(",", $.outcome))),
    outcome: () => choice("success", "failure"),
    patience: ($) => seq("patience", $._expression),
    start: ($) => seq("start", block($.start_line)),
    start_line: ($) => seq(field("target", $.reference), value($)),
    end: ($) => seq("end", choice(seq("on", field("event", $._expression)), seq("after", field("time", $._expression)))),
    reward: ($) => seq("reward", block($.reward_line, $.price, $.otherwise)),
    reward_line: ($) => seq("on", field("event", $._expression), ":", field("value", $._expression)),
    price: ($) =>
      seq(optional(seq("while", field("condition", $._expression), ",")), "per", field("per", $._expression), ":", field("value", $._expression)),
    otherwise: ($) => seq("otherwise", ":", field("value", $._expression)),

    learn: ($) =>
      seq("learn", optional(seq(field("name", $._name), "for")), field("task", $._name), block($.start, $.setting)),

    // ---- trees and claims

    tree: ($) =>
      seq("tree", field("name", $._name), optional($.parameters), optional(seq("for", field("task", $._name))), "=", field("root", $._node)),
    _node: ($) => choice($.composite, $.guarded, $._expression),
    composite: ($) => seq(optional("memory"), field("kind", $.reference), field("children", $.children)),
    guarded: ($) => seq(field("guard", $._expression), "=>", field("node", $._node)),
    children: ($) => seq("{", optional(list($._node)), "}"),

    claim: ($) =>
      seq(
        "claim", field("tree", $._name),
        choice(seq("equals", field("other", $._name)), seq("never", field("never", $._expression)), seq("reaches", field("reaches", $._expression))),
        repeat(choice($.within, $.probability)),
      ),
    within: ($) => seq("within", $._expression),
    probability: ($) => prec.left(seq("with", "probability", ">=", $._expression)),

    // ---- tests

    test: ($) => seq("test", field("title", $.string), "of", field("tree", $.reference), block($.given, $.test_tick)),
    given: ($) => seq("given", $._changes),
    test_tick: ($) =>
      seq("tick", optional($._changes), optional(seq("for", field("time", $._expression))), "=>", $.step, repeat(seq(",", $.step))),
    _changes: ($) => seq($._expression, repeat(seq(",", $._expression))),
    step: ($) => seq(field("name", $.reference), optional(field("answer", $.answer))),
    answer: () => choice("succeeds", "fails", "runs"),

    // ---- statements

    block: ($) => seq("{", repeat($._statement), "}"),
    _statement: ($) => choice(alias($.binding, $.let), $.for, $.if, $.assignment, $.reference),
    binding: ($) => seq("let", field("name", $._name), optional(typed($)), value($)),
    for: ($) => seq("for", field("name", $._name), "in", field("kind", $._name), field("body", $.block)),
    if: ($) => seq("if", field("condition", $._expression), field("then", $.block), optional(seq("else", field("else", choice($.if, $.block))))),
    assignment: ($) => seq(field("target", $.reference), choice("=", "+=", "-=", "*=", "/="), field("value", $._expression)),

    // ---- expressions

    _expression: ($) =>
      choice($.binary, $.not, $.sign, $.coordinate, $.quantity, $.boolean, $.reference, $.choice, $.paren, $.string),

    binary: ($) => {
      const row = (precedence, operator) =>
        prec.left(precedence, seq(field("left", $._expression), field("operator", operator), field("right", $._expression)));
      return choice(
        row(PREC.or, "or"),
        row(PREC.and, "and"),
        row(PREC.compare, choice("==", "!=", "<=", ">=", "<", ">", "is", seq("is", "not"))),
        row(PREC.sum, choice("+", "-")),
        row(PREC.term, choice("*", "/")),
        prec.right(PREC.power, seq(field("left", $._expression), field("operator", "^"), field("right", $._expression))),
      );
    },
    not: ($) => prec(PREC.not, seq("not", $._expression)),
    sign: ($) => prec(PREC.sign, seq(choice("-", "+"), $._expression)),
    coordinate: ($) => prec(PREC.coordinate, seq($._expression, ".", field("coordinate", choice("x", "y")))),
    paren: ($) => seq("(", $._expression, optional(seq(",", $._expression)), ")"),

    choice: ($) => seq("if", field("condition", $._expression), field("then", $.yield), "else", field("else", choice($.choice, $.yield))),
    yield: ($) => seq("{", repeat(alias($.binding, $.let)), $._expression, "}"),

    reference: ($) => prec.right(seq(field("name", $._name), optional($.arguments))),
    arguments: ($) => seq("(", optional(list(choice($._expression, $.range, $.named, $.binder))), ")"),
    range: ($) => seq($._expression, "..", $._expression),
    named: ($) => seq(field("name", $._name), value($)),
    binder: ($) => seq(field("name", $._name), "in", field("kind", $._name), optional(seq(":", $._expression))),

    parameters: ($) => seq("(", optional(list($.parameter)), ")"),
    _given_parameters: ($) => seq("(", list($.parameter), ")"),
    parameter: ($) => seq(field("name", $._name), typed($), optional(value($))),
    type: ($) => seq($._name, repeat(seq(choice("*", "/"), $._name))),

    // ---- tokens

    quantity: ($) => seq($.number, optional($.unit)),
    number: () =>
      token(choice(/0[xX][0-9A-Fa-f]+/, /([0-9][0-9_]*(\.[0-9][0-9_]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?/)),
    boolean: () => choice("true", "false"),
    _name: ($) => choice($.identifier, $.quoted_name),
    identifier: () => /[A-Za-z_][A-Za-z0-9_]*/,
    quoted_name: () => /`[^`\n]+`/,
    string: () => /"[^"\n]*"/,
    pin: () => /sha256:[0-9a-fA-F]{64}/,
    comment: () => token(seq("//", /[^\n]*/)),
    doc_comment: () => token(prec(1, seq(choice("///", "//!"), /[^\n]*/))),
  },
});
