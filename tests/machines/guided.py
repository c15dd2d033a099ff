"""Machines of slides: blocks in slots, yokes, couplings, wedges."""

from __future__ import annotations

from machine import Points, machine, reach, tip, towards, turn


@machine("OA ABM B frame:O", slides="3 along frame at B on 4,1", at=(40, 200))
def offset_slider_crank(t: float) -> Points:
    O, A = 0j, 40 * turn(t)
    B = reach(A, 130, 12j, 4 + 1j)
    M = A + (B - A) * (0.4 + 0.3j)
    return locals()


@machine("OA A PB BC C frame:OP", slides="2 along 3 at A on PB; 5 along frame at C on 1,0", at=(50, 200))
def whitworth_quick_return(t: float) -> Points:
    O, P = 0j, 0 - 20j
    A = O + 50 * turn(t)
    B = P - 80 * (A - P) / abs(A - P)
    C = reach(B, 200, 0j, 1)
    return locals()


@machine("OA A PB B T frame:OP", slides="2 along 3 at A on PB; 4 along 5 at B on 0,1; 5 along frame at T on 1,0",
         at=(60, 250))
def shaper(t: float) -> Points:
    O, P = 180j, 0j
    A = O + 120 * turn(t)
    B = towards(P, 360, A)
    T = complex(B.real - 110, 340)
    return locals()


@machine("OA A PB BC C frame:OP", slides="2 along 3 at A on PB; 5 along frame at C on 1,0", at=(120, 300))
def crank_shaper_with_rod(t: float) -> Points:
    O, P = 180j, 0j
    A = O + 90 * turn(t)
    B = towards(P, 380, A)
    C = reach(B, 160, 420j, 1)
    return locals()


@machine("OA A T frame:O", slides="2 along 3 at A on 0,1; 3 along frame at T on 1,0", at=(40, 200))
def scotch_yoke(t: float) -> Points:
    O, A = 0j, 50 * turn(t)
    T = A.real + 120 + 0j
    return locals()


@machine("ABM A B frame:O", slides="2 along frame at A on 1,0; 3 along frame at B on 0,1", drives="2/frame", at=(40, -70))
def elliptic_trammel(t: float) -> Points:
    O, A = 0j, t + 0j
    B = 1j * (100**2 - t**2) ** 0.5
    M = A + (A - B) * 0.4
    return locals()


@machine("ABM A B frame:O", slides="2 along frame at A on 1,0; 3 along frame at B on 1,2", at=(30, 100))
def skew_trammel_by_its_bar(t: float) -> Points:
    O, u = 0j, 100 * turn(t)
    B = u.imag / 2 * (1 + 2j)
    A = B - u
    M = A + u * (0.5 + 0.5j)
    return locals()


@machine("OU C PV frame:OP", slides="2 along 1 at C on OU; 2 along 3 at C on PV", at=(35, 70))
def oldham_coupling(t: float) -> Points:
    O, P, u = 0j, 20 + 0j, turn(t)
    C = u * u.real * 20
    U, V = 60 * u, P + 60j * u
    return locals()


@machine("O P C frame:OP", slides="3 along 1 at C on 3,4; 3 along 2 at C on -4,3")
def oldham_coupling_of_points() -> Points:
    O, P, C = 0j, 25 + 0j, 9 + 12j
    return locals()


@machine("ram:AR block:A tiller:OT frame:O", slides="block along tiller at A on OT; ram along frame at R on 1,0",
         drives="ram/frame", at=(30, -55))
def rapson_slide(t: float) -> Points:
    O, A = 0j, t + 80j
    R, T = A - 60, towards(O, 150, A)
    return locals()


@machine("OA ABM P frame:OP", slides="2 along 3 at A on AB", at=(60, 200))
def turning_block_linkage(t: float) -> Points:
    O, P, A = 0j, 110 + 10j, 45 * turn(t)
    B = towards(A, 190, P)
    M = B + (B - A) * 0.2j
    return locals()


@machine("OA c1:P r1:A c2:Q r2:A frame:OPQ", slides="r1 along c1 at A on PA; r2 along c2 at A on QA", at=(70, 190))
def oscillating_cylinder_engine(t: float) -> Points:
    O, P, Q, A = 0j, 150 - 5j, 5 + 150j, 40 * turn(t)
    return locals()


@machine("OA A PB frame:OP", slides="2 along 3 at A on PB", at=(150, 195))
def geneva_slot(t: float) -> Points:
    O, P, A = 0j, -71 + 0j, 50 * turn(t)
    B = towards(P, 60, A)
    return locals()


@machine("OC ACB A frame:O", slides="3 along frame at A on 1,0", at=(40, 110))
def scott_russell(t: float) -> Points:
    O, C = 0j, 50 * turn(t)
    A = C.real * 2 + 0j
    B = 2 * C - A
    return locals()


@machine("wedge:W block:B rod:BT frame:O", drives="wedge/frame",
         slides="wedge along frame at W on 1,0; block along wedge at B on 4,1; rod along frame at T on 0,1")
def wedge_with_a_turning_block() -> Points:
    O, W, B, T = 0j, 50 + 0j, 40 + 30j, 40 + 90j
    return locals()


@machine("OA AB PB BC C frame:OP", slides="5 along frame at C on 0,1", at=(60, 210))
def toggle_press(t: float) -> Points:
    O, P, A = 0j, 200 + 160j, 30 * turn(t)
    B = tip(P, 150, A, 180)
    C = reach(B, 170, 200 + 0j, -1j)
    return locals()


@machine("OL LBH B frame:O", slides="3 along frame at B on 0,1", at=(75, 60))
def bottle_jack_lever(t: float) -> Points:
    O, L = 0j, 40 * turn(t)
    B = reach(L, 30, 25 + 0j, 1j)
    H = L + (B - L) * 9
    return locals()


@machine("A AB AC OBM PCN frame:OP", slides="1 along frame at A on 0,1", drives="1/frame", at=(10, -8))
def gripper(t: float) -> Points:
    O, P, A = -30 + 40j, 30 + 40j, t * 1j
    B, C = tip(O, 35, A, 45), tip(A, 45, P, 35)
    M, N = O + (B - O) * (-1 + 1j), P + (C - P) * (-1 - 1j)
    return locals()
