"""One pose of Rosenauer's closed eight-link chain (No. 15), as an engineer would write it in plain Python.

The construction of the scene `alt-eight-link` and no other: auxiliary points Q and R for the velocities, the plan of
relative normal accelerations with a trial triangle from either side for the accelerations. Points and vectors are
complex numbers, textbook letters: F_ is the conjugate of F, so that (u * v_).imag is zero where u and v are parallel,
and a line through P along u meets one through S along v at P + u ((S - P) v_).imag / (u v_).imag.
"""

from __future__ import annotations

O, N, M = 0j, -220 - 30j, 145 - 95j  # the pivots of the frame
OMEGA = 10.0  # of the crank O F G, rad/s, uniform


def one_pose(F: complex, G: complex, A: complex, B: complex, C: complex, D: complex, E: complex) -> tuple[complex, ...]:
    """The velocities of F, G, A, B, C, D, E and then their accelerations, mm and s."""
    FB, NA, GE, MD = B - F, A - N, E - G, D - M
    AB, CA, CB, CD, CE, DE = B - A, A - C, B - C, D - C, E - C, E - D
    FB_, NA_, GE_, MD_ = FB.conjugate(), NA.conjugate(), GE.conjugate(), MD.conjugate()

    # Ends of the orthogonal velocities, at the scale at which v_f and v_g lie in O.
    Q = F + FB * (((N - F) * NA_).imag / (FB * NA_).imag)
    R = G + GE * (((M - G) * MD_).imag / (GE * MD_).imag)
    v_q = N + NA * (((O - N) * FB_).imag / (NA * FB_).imag)
    v_r = M + MD * (((O - M) * GE_).imag / (MD * GE_).imag)
    QC, RC_ = C - Q, (C - R).conjugate()
    v_c = v_q + QC * (((v_r - v_q) * RC_).imag / (QC * RC_).imag)
    v_a = v_c + CA * (((N - v_c) * NA_).imag / (CA * NA_).imag)
    v_b = v_c + CB * (((O - v_c) * FB_).imag / (CB * FB_).imag)
    v_d = v_c + CD * (((M - v_c) * MD_).imag / (CD * MD_).imag)
    v_e = v_c + CE * (((O - v_c) * GE_).imag / (CE * GE_).imag)
    u_a, u_b, u_c, u_d, u_e, u_f, u_g = v_a - A, v_b - B, v_c - C, v_d - D, v_e - E, O - F, O - G

    # The plan of relative normal accelerations: by semicircles v^2 / l, along each side.
    u_ca, u_cd, u_fb, u_ge = u_a - u_c, u_d - u_c, u_b - u_f, u_e - u_g
    n_3 = (u_ca * u_ca.conjugate()).real / (CA * CA.conjugate()).real
    n_6 = (u_cd * u_cd.conjugate()).real / (CD * CD.conjugate()).real
    n_2 = (u_fb * u_fb.conjugate()).real / (FB * FB_).real
    n_4 = (u_a * u_a.conjugate()).real / (NA * NA_).real
    n_5 = (u_ge * u_ge.conjugate()).real / (GE * GE_).real
    n_7 = (u_d * u_d.conjugate()).real / (MD * MD_).real
    c = 0j
    a, b, d, e = c + CA * n_3, c + CB * n_3, c + CD * n_6, c + CE * n_6
    f_1, n, g_1, m = b - FB * n_2 + u_f, a - NA * n_4, e - GE * n_5 + u_g, d - MD * n_7

    # alpha and beta, delta and epsilon are perpendicular to NA and FB, MD and GE; a trial triangle of the links' own
    # size, a quarter turned, hangs between each two.
    alpha, delta = 1j * NA, 1j * MD
    U_1 = n + alpha * (((f_1 - n) * FB_).real / (alpha * FB_).real)
    U_2 = m + delta * (((g_1 - m) * GE_).real / (delta * GE_).real)
    A_1 = n + alpha * (((f_1 - n - 1j * AB) * FB_).real / (alpha * FB_).real)
    D_1 = m + delta * (((g_1 - m - 1j * DE) * GE_).real / (delta * GE_).real)
    B_1, C_1 = A_1 + 1j * AB, A_1 - 1j * CA
    E_1, C_2 = D_1 + 1j * DE, D_1 - 1j * CD
    gamma_1, gamma_2 = C_1 - U_1, C_2 - U_2
    s_1 = ((U_2 - U_1) * gamma_2.conjugate()).imag / (gamma_1 * gamma_2.conjugate()).imag
    s_2 = ((U_2 - U_1) * gamma_1.conjugate()).imag / (gamma_1 * gamma_2.conjugate()).imag
    j_a, j_b, j_c = U_1 + (A_1 - U_1) * s_1 - a, U_1 + (B_1 - U_1) * s_1 - b, U_1 + gamma_1 * s_1 - c
    j_d, j_e = U_2 + (D_1 - U_2) * s_2 - d, U_2 + (E_1 - U_2) * s_2 - e

    v, j = -1j * OMEGA, OMEGA * OMEGA
    return (v * u_f, v * u_g, v * u_a, v * u_b, v * u_c, v * u_d, v * u_e,
            j * u_f, j * u_g, j * j_a, j * j_b, j * j_c, j * j_d, j * j_e)
