[
  (world)
  (robot)
  (variants)
  (behavior)
  (task)
  (start)
  (reward)
  (learn)
  (test)
  (children)
  (block)
  (yield)
  (arguments)
  (parameters)
] @indent.begin

["}" ")"] @indent.end @indent.branch
