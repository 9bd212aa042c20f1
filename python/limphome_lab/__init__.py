"""What a person does with limphome: run it, look at it, study many runs, measure it.

Each kind of work has a room. What several rooms share lies on top, beside this file. A room uses the top and no other
room but those named here (test/lab/test_rooms.py):

    show     a run, while it goes on or afterwards      -
    run      trains, evaluates, launches                show
    view     the robot in a browser, live or recorded   show, run
    gym      the task for learners of others            run
    export   a run as files of other tools              show
    study    many runs side by side                     show, run
    measure  simulator, speed, the tests themselves     run, show

The top uses no room. `limphome`, the package of message types, is made by lcm-gen and lies beside this one.
"""
