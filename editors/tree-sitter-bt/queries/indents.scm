[
  (world)
  (robot)
  (variants)
  (behavior)
  (task)
  (start)
  (reward)
  (learn)
  (children)
  (block)
  (yield)
  (arguments)
  (parameters)
] @indent.begin

["}" ")"] @indent.end @indent.branch
