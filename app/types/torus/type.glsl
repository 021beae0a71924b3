// SPDX-License-Identifier: MIT
// A torus about the z axis. The ray meets it where a quartic is 0. Roots of a polynomial lie between those of its derivative
// (Yuksel, High-Performance Polynomial Root Finding for Graphics, HPG 2022): quadratic, cubic, quartic, each bracketed. A
// grazing ray is decided by the sign of the quartic at its minimum, so outlines are as sharp as the numbers.
real3 bound(Shape s) { return real3(s.major + s.minor, s.major + s.minor, s.minor); }

real inside(Shape s, real3 p) { // the distance to the surface
  real ring = length(p.xy) - s.major;
  return sqrt(ring * ring + p.z * p.z) - s.minor;
}

real3 surface(Shape s, real3 p) {
  real away = length(p.xy);
  return real3(p.xy * ((away - s.major) / max(away, real(1e-30))), p.z);
}

// c[0] + c[1] t + c[2] t^2 + ... and its derivative
struct Quartic { real c0, c1, c2, c3; }; // t^4 has 1
real2 at(Quartic q, real t, bool slope) { // of q, or of its derivative, with slope
  real2 f = real2((((t + q.c3) * t + q.c2) * t + q.c1) * t + q.c0, ((real(4.0) * t + real(3.0) * q.c3) * t + real(2.0) * q.c2) * t + q.c1);
  real second = (real(12.0) * t + real(6.0) * q.c3) * t + real(2.0) * q.c2;
  return slope ? real2(f.y, second) : f;
}

// The one root between lo and hi, where the signs differ: Newton's steps, halving where they leave the bracket.
real root_between(Quartic q, bool slope, real lo, real hi) {
  bool falls = at(q, lo, slope).x > real(0.0);
  real t = real(0.5) * (lo + hi);
  int steps = 0;
  bool going = true;
  do {
    real2 f = at(q, t, slope);
    bool left = (f.x > real(0.0)) == falls;
    lo = left ? t : lo;
    hi = left ? hi : t;
    real next = t - f.x / f.y;
    next = next > lo && next < hi ? next : real(0.5) * (lo + hi);
    going = next != t && ++steps < 64;
    t = next;
  } while (going);
  return t;
}
// The same, or `hi` where the signs do not differ.
real root_or_end(Quartic q, bool slope, real lo, real hi) {
  return (at(q, lo, slope).x > real(0.0)) != (at(q, hi, slope).x > real(0.0)) && lo < hi ? root_between(q, slope, lo, hi) : hi;
}

// The quartic takes some of the distance's precision; a step of Newton on the distance itself gives it back.
real polished(Shape s, real3 o, real3 d, real t) {
  real3 p = o + t * d, n = surface(s, p);
  real slope = dot(n, d) / max(length(n), real(1e-30)), step_ = inside(s, p) / slope;
  return abs(slope) > real(0.02) * length(d) ? t - step_ : t;
}

bool hit(Shape s, real3 o, real3 d, out real t_in, out real t_out) {
  t_in = t_out = real(0.0);
  // lengths in units of the whole radius, times in units of it along the ray
  real whole = s.major + s.minor, speed = length(d), R = s.major / whole, r = s.minor / whole;
  real3 a = o / whole, u = d / speed;
  real au = dot(a, u), aa = dot(a, a), away = length(a.xy), A = aa + (R - r);
  real h2 = real(1.001) - aa + au * au; // of a ball a little larger, where the quartic is above 0 for sure
  if (!(h2 > real(0.0)) || !(s.minor > real(0.0))) return false;
  real h = sqrt(h2), first = -au - h, last = -au + h;
  real ring = away - R, tube = sqrt(ring * ring + a.z * a.z), across = dot(u.xy, u.xy), R4 = real(4.0) * R * R;
  Quartic q = Quartic((tube - r) * (tube + r) * (A + real(2.0) * R * away), real(4.0) * au * A - real(2.0) * R4 * dot(a.xy, u.xy),
                      real(4.0) * au * au + real(2.0) * A - R4 * across, real(4.0) * au);
  // where the second derivative is 0, then the first: minima and maxima of the quartic
  real inner = real(9.0) * q.c3 * q.c3 - real(24.0) * q.c2, e = sqrt(max(inner, real(0.0))) / real(12.0);
  real i1 = clamp(real(-0.25) * q.c3 - e, first, last), i2 = clamp(real(-0.25) * q.c3 + e, first, last);
  real k1 = root_or_end(q, true, first, i1), k2 = root_or_end(q, true, i1, i2), k3 = root_or_end(q, true, i2, last);
  bool m1 = at(q, k1, false).x <= real(0.0), m2 = at(q, k2, false).x <= real(0.0), m3 = at(q, k3, false).x <= real(0.0);
  if (!(m1 || m2 || m3)) return false;
  real left = m1 ? k1 : m2 ? k2 : k3, left_from = m1 ? first : m2 ? k1 : k2;
  real right = m3 ? k3 : m2 ? k2 : k1, right_to = m3 ? last : m2 ? k3 : k2;
  t_in = polished(s, o, d, whole / speed * root_or_end(q, false, left_from, left));
  t_out = max(t_in, polished(s, o, d, whole / speed * root_or_end(q, false, right, right_to)));
  return true;
}
