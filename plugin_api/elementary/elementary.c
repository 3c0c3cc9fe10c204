/* The elementary functions of <math.h>, with the same bits on every machine: SLEEF's implementations without fused
   multiply-add (Shibata and Petrogalli 2020, doi 10.1109/TPDS.2019.2960333). Trigonometric ones and their inverses are
   at most 3.5 ulp off, which takes as long as the C library, erfc 1.5, all others 1.

   Those of the C library choose by the processor: where it has FMA, results differ in the last bit, and a robot that
   walks goes another way within a second. What a plugin of muster calls is bound to these when it is linked, ahead of
   the C library's. What that has once for all processors stays: hypot, log10, log1p, exp2, cbrt; and sqrt, fma, floor
   and the like, which are exact. */
#include <math.h>
#include <sleef.h>

/* Of a pair of lanes one is used. The bits are those of SLEEF's portable functions of one value, most of which take up
   to twice as long: exp 17 ns for 8, sin 16 for 9, pow 63 for 43 (AMD EPYC, SLEEF 3.5.1, one after the other). But for
   the cosine just below 0, where its lanes are an ulp below 1. */
#if defined(__x86_64__)
#include <emmintrin.h>
#define OF_ONE(name, ulp) _mm_cvtsd_f64(Sleef_cinz_##name##d2_##ulp##sse2(_mm_set1_pd(x)))
#define OF_TWO(name, ulp, a, b) _mm_cvtsd_f64(Sleef_cinz_##name##d2_##ulp##sse2(_mm_set1_pd(a), _mm_set1_pd(b)))
#else
#define OF_ONE(name, ulp) Sleef_cinz_##name##d1_##ulp##purec(x)
#define OF_TWO(name, ulp, a, b) Sleef_cinz_##name##d1_##ulp##purec(a, b)
#endif

double sin(double x) { return OF_ONE(sin, u35); }
double cos(double x) { return x < 0 && x > -1e-15 ? Sleef_cinz_cosd1_u35purec(x) : OF_ONE(cos, u35); }
double tan(double x) { return OF_ONE(tan, u35); }
double asin(double x) { return OF_ONE(asin, u35); }
double acos(double x) { return OF_ONE(acos, u35); }
double atan(double x) { return OF_ONE(atan, u35); }
double atan2(double y, double x) { return OF_TWO(atan2, u35, y, x); }
double exp(double x) { return OF_ONE(exp, u10); }
double expm1(double x) { return OF_ONE(expm1, u10); }
double log(double x) { return OF_ONE(log, u10); }
double log2(double x) { return OF_ONE(log2, u10); }
double pow(double x, double y) { return OF_TWO(pow, u10, x, y); }
double sinh(double x) { return OF_ONE(sinh, u10); }
double cosh(double x) { return OF_ONE(cosh, u10); }
double tanh(double x) { return OF_ONE(tanh, u10); }
double asinh(double x) { return OF_ONE(asinh, u10); }
double acosh(double x) { return OF_ONE(acosh, u10); }
double atanh(double x) { return OF_ONE(atanh, u10); }
double erf(double x) { return OF_ONE(erf, u10); }
double erfc(double x) { return OF_ONE(erfc, u15); }
double lgamma(double x) { return OF_ONE(lgamma, u10); }
double tgamma(double x) { return OF_ONE(tgamma, u10); }

/* What compilers make of a sine beside a cosine. */
void sincos(double x, double *sine, double *cosine);
void sincos(double x, double *sine, double *cosine) {
  *sine = OF_ONE(sin, u35);
  *cosine = cos(x);
}
