[(behavior) (predicate) (tree) (let) (block) (yield)] @local.scope
(parameter name: (_) @local.definition.parameter)
(let name: (_) @local.definition.var)
(for name: (_) @local.definition.var)
(binder name: (_) @local.definition.var)
(reference name: (_) @local.reference)
