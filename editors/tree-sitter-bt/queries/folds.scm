[
  (world)
  (robot)
  (enum)
  (behavior)
  (task)
  (start)
  (reward)
  (learn)
  (test)
  (children)
  (block)
  (yield)
] @fold
