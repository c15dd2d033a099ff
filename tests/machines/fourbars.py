"""Four-bars that have names, and what hangs on them: lengths in mm, the crank's angle in degrees."""

from __future__ import annotations

from machine import Points, machine, mirror, reach, tip, towards, turn


@machine("OA AB PB frame:OP", at=(40, 250))
def antiparallelogram(t: float) -> Points:
    O, P, A = 0j, 25 + 0j, 60 * turn(t)
    B = mirror(P + A, A, P)
    return locals()


@machine("OA AB PB frame:OP", at=(50, 130))
def kite(t: float) -> Points:
    O, P, A = 0j, 60 + 0j, 60 * turn(t)
    B = tip(A, 110, P, 110)
    return locals()


@machine("OA AB PB BC C frame:OP", slides="5 along frame at C on 1,0", at=(30, 220))
def drag_link_with_ram(t: float) -> Points:
    O, P, A = 0j, 30 + 0j, 100 * turn(t)
    B = tip(A, 90, P, 80)
    C = reach(B, 260, O, 1)
    return locals()


@machine("OA ABM PB frame:OP", at=(100, 260))
def chebyshev_lambda(t: float) -> Points:
    O, P, A = 0j, 40 + 0j, 20 * turn(t)
    B = tip(A, 50, P, 50)
    M = towards(A, 100, B)
    return locals()


@machine("OA ABM PB frame:OP", at=(60, 45))
def chebyshev_crossed(t: float) -> Points:
    O, P, A = 0j, 40 + 0j, 50 * turn(t)
    B = tip(P, 50, A, 20)
    M = (A + B) / 2
    return locals()


@machine("OA ABM PB frame:OP", at=(70, 58))
def roberts(t: float) -> Points:
    O, P, A = 0j, 80 + 0j, 50 * turn(t)
    B = tip(A, 40, P, 50)
    M = tip(B, 50, A, 50)
    return locals()


@machine("OA ABM PB frame:OP", at=(8, -12))
def watt_straight_line(t: float) -> Points:
    O, P = -50 + 10j, 50 - 10j
    A = O + 50 * turn(t)
    B = tip(P, 50, A, 20)
    M = (A + B) / 2
    return locals()


@machine("OB ABC PA frame:OP", at=(25, -15))
def evans_grasshopper(t: float) -> Points:
    O, P, B = 0j, 98 - 120j, 50 * turn(t)
    A = tip(B, 50, P, 120)
    C = 2 * B - A
    return locals()


@machine("OAD ABC PB DE E frame:OP", slides="5 along frame at E on 0,1", at=(35, 160))
def sewing_machine_thread_lever(t: float) -> Points:
    O, P = 0j, -8 + 30j
    A, D = 11 * turn(t), 15 * turn(t - 20)
    B = tip(P, 24, A, 27)
    C = A + (B - A) * (1.9 + 0.4j)
    E = reach(D, 40, O, -1j)
    return locals()


@machine("OA AB PBC CD QDW frame:OPQ", at=(70, 200))
def windscreen_wiper(t: float) -> Points:
    O, P, Q, A = 0j, 180 + 40j, 480 + 35j, 25 * turn(t)
    B = tip(A, 175, P, 55)
    C = P + (B - P) * 0.7 * turn(20)
    D = tip(C, 300, Q, 52)
    W = Q + (D - Q) * 7j
    return locals()


@machine("jib:ODA stay:PB nose:BAC screw:Q nut:D frame:OPQ", slides="nut along screw at D on QD", drives="nut/screw",
         at=(75, 95))
def level_luffing_crane(t: float) -> Points:
    O, P, Q = 0j, -40 + 20j, -35 - 10j
    D = tip(Q, t, O, 70)
    A = towards(O, 150, D)
    B = tip(A, 35, P, 140)
    C = A + (A - B) * 2.5
    return locals()


@machine("upper:PDC lower:CA leg:OAW cylinder:Q rod:D frame:OPQ", slides="rod along cylinder at D on QD",
         drives="rod/cylinder", at=(70, 90))
def landing_gear(t: float) -> Points:
    O, P, Q = 0j, -90 + 0j, -100 + 70j
    D = tip(Q, t, P, 40)
    C = towards(P, 70, D)
    A = tip(O, 70, C, 75)
    W = towards(O, 130, A)
    return locals()


@machine("OA AB PB BC QCJ frame:OPQ", at=(20, 130))
def jaw_crusher(t: float) -> Points:
    O, P, Q, A = 0j, 200 - 360j, -260 + 60j, 30 * turn(t)
    B = tip(P, 210, A, 350)
    C = tip(B, 200, Q, 400)
    J = tip(Q, 500, C, 120)
    return locals()
