== wide.bt
/// 😀 größe
predicate `größe 😀`
behavior `😀`
tree t = selector { `größe 😀` => `😀`, `😀` } // 😀
==
open wide.bt
hover wide.bt { `größe 😀|` =>
references wide.bt => `|😀`,
rename wide.bt => `|😀`, ~> smile
change wide.bt => `😀`, `😀` ~> => `😀`, `😀😀`
actions wide.bt , `😀|😀`
apply wide.bt 0
change wide.bt `😀` } // 😀 ~> `😀` } 😀 // 😀
colours wide.bt
