; What stands further down goes before what stands above.

(comment) @comment
(doc_comment) @comment.documentation
(string) @string
(pin) @string.special
(number) @number
(unit) @type
(boolean) @boolean
(outcome) @constant.builtin
(answer) @constant.builtin

(identifier) @variable
(quoted_name) @variable
(type) @type
(type (_) @type)

["(" ")" "{" "}"] @punctuation.bracket
["," ":" "."] @punctuation.delimiter
["=" "+=" "-=" "*=" "/=" "==" "!=" "<=" ">=" "<" ">" "+" "-" "*" "/" "^" "->" "→" "=>" ".."] @operator
["and" "or" "not" "is" "of" "per"] @keyword.operator

[
  "world" "enum" "input" "state" "event" "predicate" "behavior" "task" "learn" "tree" "claim" "test" "let" "place" "wall" "robot"
  "sensor" "local"
] @keyword
[
  "each" "tick" "on" "facing" "requires" "succeed" "fail" "when" "control" "observe" "choose" "history" "last" "patience"
  "start" "end" "after" "reward" "otherwise" "while" "equals" "never" "reaches" "within" "with" "probability" "memory" "given"
] @keyword
(price "per" @keyword)
(claim "never" @keyword)
(test "of" @keyword)
"use" @keyword.import
"std" @module
["if" "else"] @keyword.conditional
["for" "in"] @keyword.repeat
(tree "for" @keyword)
(learn "for" @keyword)
(test_tick "for" @keyword)

(reference name: (_) @function.call (arguments))
(setting name: (_) @property)
(named name: (_) @variable.parameter)
(binder name: (_) @variable.parameter)
(for name: (_) @variable.parameter)
(parameter name: (_) @variable.parameter)
(coordinate coordinate: _ @property)
(variants (_) @constant)

(world name: (_) @type.definition)
(robot name: (_) @type.definition)
(enum name: (_) @type.definition)
(task name: (_) @type.definition)
(place name: (_) @constant)
(wall name: (_) @constant)
(sensor name: (_) @constant)
(state name: (_) @variable)
(local name: (_) @variable)
(predicate name: (_) @function)
(behavior name: (_) @function)
(let name: (_) @function (parameters))
(tree name: (_) @function)
(learn name: (_) @function)
(learn task: (_) @type)
(tree task: (_) @type)
(claim tree: (_) @function)
(claim other: (_) @function)
(test tree: (reference name: (_) @function))

(composite kind: (reference name: (_) @keyword.control))
