[
  (world)
  (robot)
  (enum)
  (behavior)
  (task)
  (start)
  (reward)
  (learn)
  (children)
  (block)
  (yield)
] @fold
