"""Open chains and parallel robots: several drives."""

from __future__ import annotations

from machine import Points, machine, reach, tip, turn


@machine("OA ABE frame:O", drives="1 2", at=((30, 80), (120, 20)))
def scara(s: float, t: float) -> Points:
    O, A = 0j, 200 * turn(s)
    B, E = A + 160 * turn(t), A + 190 * turn(t + 20)
    return locals()


@machine("OA AB BC frame:O", drives="1 2-1 3-2", at=((30, 80, -20), (120, 20, 100)))
def open_chain_with_relative_drives(r: float, s: float, t: float) -> Points:
    O, A = 0j, 100 * turn(r)
    B = A + 80 * turn(s)
    C = B + 60 * turn(t)
    return locals()


@machine("OA ABE BC PC frame:OP", drives="1 4", at=((110, 60), (130, 80)))
def five_bar(s: float, t: float) -> Points:
    O, P = 0j, 60 + 0j
    A, C = 80 * turn(s), P + 80 * turn(t)
    B = tip(A, 110, C, 110)
    E = A + (B - A) * 1.3
    return locals()


@machine("OA AB BC PC frame:OP", drives="1 2-1", at=((110, 30), (80, 10)))
def five_bar_driven_at_the_elbow(s: float, t: float) -> Points:
    O, P, A = 0j, 90 + 0j, 80 * turn(s)
    B = A + 90 * turn(t)
    C = tip(B, 70, P, 90)
    return locals()


LEGS = ((50, 55, 65), (60, 45, 40))


@machine("ABCM c1:O r1:A c2:P r2:B c3:Q r3:C frame:OPQ", drives="r1/c1 r2/c2 r3/c3", at=LEGS,
         slides="r1 along c1 at A on OA; r2 along c2 at B on PB; r3 along c3 at C on QC")
def three_rpr(x: float, y: float, t: float) -> Points:
    O, P, Q, M = 0j, 120 + 0j, 50 + 130j, complex(x, y)
    A, B, C = (M + 25 * turn(t + k) for k in (215, -40, 95))
    return locals()


@machine("OA PB QC AD BE CF DEFM frame:OPQ", drives="1 2 3", at=LEGS)
def three_rrr(x: float, y: float, t: float) -> Points:
    O, P, Q, M = 0j, 120 + 0j, 50 + 130j, complex(x, y)
    D, E, F = (M + 25 * turn(t + k) for k in (215, -40, 95))
    A, B, C = tip(O, 45, D, 50), tip(P, 50, E, 45), tip(Q, 45, F, 50)
    return locals()


@machine("A B AC BCE frame:O", drives="1/frame 2/frame", at=((0, 90), (20, 120)),
         slides="1 along frame at A on 1,0; 2 along frame at B on 1,0")
def two_sliders_on_a_rail(s: float, t: float) -> Points:
    O, A, B = 50 + 0j, s + 0j, t + 5j
    C = tip(A, 80, B, 90)
    E = B + (C - B) * 1.4
    return locals()


@machine("OAB BCP AT TC cart:W arm:T frame:O", drives="cart/frame arm/cart", at=((-60, 40), (-50, 60)),
         slides="cart along frame at W on 1,0; arm along cart at T on 0,1")
def pantograph(x: float, y: float) -> Points:
    O, T = 0j, complex(x, y)
    A = tip(O, 60, T, 60)
    B, P = 2.5 * A, 2.5 * T
    C, W = B + T - A, x - 30j
    return locals()


@machine("OAB BCP AT TC frame:O", drives="1 2", at=((100, -20), (140, 30)))
def pantograph_by_its_bars(s: float, t: float) -> Points:
    O, A, T = 0j, 60 * turn(s), 60 * turn(s) + 60 * turn(t)
    B, P, C = 2.5 * A, 2.5 * T, 1.5 * A + T
    return locals()


@machine("cart:WK pole:KT frame:O", drives="cart/frame pole-cart", slides="cart along frame at W on 1,0", at=((30, 80), (-20, 110)))
def crane_cart_with_pendulum(x: float, t: float) -> Points:
    O, W = 0j, x + 0j
    K = W + 20j
    T = K - 100 * turn(t)
    return locals()


@machine("OA AB BC CD PD frame:OP", drives="1 3-2 5", at=((100, 40, 110), (110, 30, 115)))
def six_links_in_a_ring(s: float, t: float, u: float) -> Points:
    O, P, A = 0j, 120 + 0j, 80 * turn(s)
    D = P + 70 * turn(u)
    B = A + 50 * turn(t)
    C = tip(B, 45, D, 60)
    return locals()


@machine("OA AB BC CD PD frame:OP", drives="2-1 3-2 5-4", at=((100, 40, 110), (110, 30, 115)))
def six_links_driven_at_their_elbows(s: float, t: float, u: float) -> Points:
    O, P, A = 0j, 120 + 0j, 80 * turn(s)
    D = P + 70 * turn(u)
    B = A + 50 * turn(t)
    C = tip(B, 45, D, 60)
    return locals()


@machine("ABCM OD DA PE EB QF FC frame:OPQ", drives="3-2 5-4 7-6", at=LEGS)
def three_rrr_driven_at_the_knees(x: float, y: float, t: float) -> Points:
    O, P, Q, M = 0j, 120 + 0j, 50 + 130j, complex(x, y)
    A, B, C = (M + 25 * turn(t + k) for k in (215, -40, 95))
    D, E, F = tip(O, 45, A, 50), tip(P, 50, B, 45), tip(Q, 45, C, 50)
    return locals()


@machine("ABCM AD BE CF d:D e:E f:F frame:OPQ", drives="d/frame e/frame f/frame", at=LEGS,
         slides="d along frame at D on OP; e along frame at E on PQ; f along frame at F on QO")
def three_prr_platform(x: float, y: float, t: float) -> Points:
    O, P, Q, M = 0j, 120 + 0j, 50 + 130j, complex(x, y)
    A, B, C = (M + 25 * turn(t + k) for k in (215, -40, 95))
    D, E, F = reach(A, 45, O, P - O), reach(B, 50, P, Q - P), reach(C, 60, Q, O - Q)
    return locals()
