"""Many poses of Rosenauer's closed eight-link chain (No. 15), as an engineer would write it for numba: one fast loop.

The construction of the scene `alt-eight-link` and no other, step by step as in `by_hand_python`, each instrument a
small function that the compiler inlines. One thread, and nothing reordered (no fastmath); a division by zero gives nan.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.complex128]
Seven = tuple[complex, complex, complex, complex, complex, complex, complex]

O, N, M = 0j, -220 - 30j, 145 - 95j  # the pivots of the frame
OMEGA = 10.0  # of the crank O F G, rad/s, uniform


@njit(error_model="numpy")
def cross(u: complex, v: complex) -> float:
    """The component of v across u, times the length of u."""
    return u.real * v.imag - u.imag * v.real


@njit(error_model="numpy")
def times(u: complex, s: float) -> complex:
    """The vector u, s times as long."""
    return complex(u.real * s, u.imag * s)


@njit(error_model="numpy")
def turned(u: complex) -> complex:
    """The vector u, a quarter turned."""
    return complex(-u.imag, u.real)


@njit(error_model="numpy")
def square(u: complex) -> float:
    """The square of the length of u."""
    return u.real * u.real + u.imag * u.imag


@njit(error_model="numpy")
def meet(P: complex, u: complex, S: complex, v: complex) -> complex:
    """Where the line through P along u meets the one through S along v."""
    return P + times(u, cross(S - P, v) / cross(u, v))


@njit(error_model="numpy")
def normal(u: complex, l: complex) -> complex:
    """The relative normal acceleration by the semicircle over the side l, u being the relative velocity."""
    return times(l, square(u) / square(l))


@njit(error_model="numpy")
def many_poses(F: Array, G: Array, A: Array, B: Array, C: Array, D: Array, E: Array) -> tuple[Array, Array]:
    """The velocities and the accelerations (mm and s) of F, G, A, B, C, D, E, each of shape (7, n)."""
    v, a = np.empty((7, len(F)), np.complex128), np.empty((7, len(F)), np.complex128)
    for i in range(len(F)):
        u, j = one_pose(F[i], G[i], A[i], B[i], C[i], D[i], E[i])
        for k in range(7):
            v[k, i] = -turned(times(u[k], OMEGA))
            a[k, i] = times(j[k], OMEGA * OMEGA)
    return v, a


@njit(error_model="numpy")
def one_pose(F: complex, G: complex, A: complex, B: complex, C: complex, D: complex, E: complex) -> tuple[Seven, Seven]:
    """The orthogonal velocities and the accelerations at the scale at which those of F are FO."""
    # Ends of the orthogonal velocities: those of F and G lie in O, those of N and M stay where they are.
    Q = meet(F, B - F, N, A - N)
    R = meet(G, E - G, M, D - M)
    v_q = meet(N, A - N, O, B - F)
    v_r = meet(M, D - M, O, E - G)
    v_c = meet(v_q, C - Q, v_r, C - R)
    v_a = meet(v_c, A - C, N, A - N)
    v_b = meet(v_c, B - C, O, B - F)
    v_d = meet(v_c, D - C, M, D - M)
    v_e = meet(v_c, E - C, O, E - G)
    u_a, u_b, u_c, u_d, u_e, u_f, u_g = v_a - A, v_b - B, v_c - C, v_d - D, v_e - E, O - F, O - G

    # The plan of relative normal accelerations, from c: abc and cde are similar to the links ABC and CDE.
    ca, cd = normal(u_a - u_c, A - C), normal(u_d - u_c, D - C)
    s_3, s_6 = square(u_a - u_c) / square(A - C), square(u_d - u_c) / square(D - C)
    a, b, d, e = ca, times(B - C, s_3), cd, times(E - C, s_6)
    f, n = b - normal(u_b - u_f, B - F), a - normal(u_a, A - N)
    g, m = e - normal(u_e - u_g, E - G), d - normal(u_d, D - M)
    f_1, g_1 = f + u_f, g + u_g

    # alpha, beta, delta and epsilon are perpendicular to NA, FB, MD and GE; between each two a trial triangle.
    alpha, beta, delta, epsilon = turned(A - N), turned(B - F), turned(D - M), turned(E - G)
    U_1, U_2 = meet(n, alpha, f_1, beta), meet(m, delta, g_1, epsilon)
    A_1 = meet(n, alpha, f_1 - turned(B - A), beta)
    D_1 = meet(m, delta, g_1 - turned(E - D), epsilon)
    B_1, C_1 = A_1 + turned(B - A), A_1 + turned(C - A)
    E_1, C_2 = D_1 + turned(E - D), D_1 + turned(C - D)
    s_1 = cross(U_2 - U_1, C_2 - U_2) / cross(C_1 - U_1, C_2 - U_2)
    s_2 = cross(U_2 - U_1, C_1 - U_1) / cross(C_1 - U_1, C_2 - U_2)
    j_a, j_b, j_c = U_1 + times(A_1 - U_1, s_1) - a, U_1 + times(B_1 - U_1, s_1) - b, U_1 + times(C_1 - U_1, s_1)
    j_d, j_e = U_2 + times(D_1 - U_2, s_2) - d, U_2 + times(E_1 - U_2, s_2) - e
    return (u_f, u_g, u_a, u_b, u_c, u_d, u_e), (u_f, u_g, j_a, j_b, j_c, j_d, j_e)
