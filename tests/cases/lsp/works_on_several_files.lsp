== world.bt
use std

world hall {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place door = disc((0.6 m, 2 m), 20 cm)
    place desk = disc((5.4 m, 2 m), 20 cm)
    robot porter {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
    }
}

predicate at_desk = inside(desk)
== tasks/carry.bt
use "../world.bt"

event there = success(goto(desk))

task carry {
    observe at_desk
    choose  goto(desk), goto(door)
    end on there
    end after 1 min
    reward { on there: 1 otherwise: -0.01 }
}
== tasks/by_hand.bt
use "carry.bt"

tree hand for carry = selector { at_desk => goto(door), goto(desk) }
== tasks/other.bt
predicate at_desk
behavior idle_here
tree other = selector { at_desk => idle_here, idle_here }
==
open tasks/carry.bt
open world.bt
references world.bt predicate at|_desk
rename world.bt predicate at|_desk ~> beside_desk
rename world.bt predicate at|_desk ~> carry
rename world.bt predicate at|_desk ~> there
definition tasks/carry.bt observe at|_desk
change world.bt predicate at_desk ~> predicate at_table
change world.bt inside(desk) ~> inside(dsk)
change world.bt inside(dsk) ~> inside(desk)
change world.bt at_table ~> at_desk
workspace desk
close world.bt
