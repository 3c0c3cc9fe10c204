/* The elementary functions of <math.h>, with the same bits on every machine: SLEEF's implementations without fused
   multiply-add (Shibata and Petrogalli 2020, doi 10.1109/TPDS.2019.2960333). Trigonometric ones and their inverses are
   at most 3.5 ulp off, which takes as long as the C library, erfc 1.5, all others 1.

   Those of the C library choose by the processor: where it has FMA, results differ in the last bit, and a robot that
   walks goes another way within a second. What a plugin of muster calls is bound to these when it is linked, ahead of
   the C library's. What that has once for all processors stays: hypot, log10, log1p, exp2, cbrt; and sqrt, fma, floor
   and the like, which are exact. */
#include <math.h>
#include <sleef.h>

double sin(double x) { return Sleef_cinz_sind1_u35purec(x); }
double cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }
double tan(double x) { return Sleef_cinz_tand1_u35purec(x); }
double asin(double x) { return Sleef_cinz_asind1_u35purec(x); }
double acos(double x) { return Sleef_cinz_acosd1_u35purec(x); }
double atan(double x) { return Sleef_cinz_atand1_u35purec(x); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u35purec(y, x); }
double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double expm1(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double log2(double x) { return Sleef_cinz_log2d1_u10purec(x); }
double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
double sinh(double x) { return Sleef_cinz_sinhd1_u10purec(x); }
double cosh(double x) { return Sleef_cinz_coshd1_u10purec(x); }
double tanh(double x) { return Sleef_cinz_tanhd1_u10purec(x); }
double asinh(double x) { return Sleef_cinz_asinhd1_u10purec(x); }
double acosh(double x) { return Sleef_cinz_acoshd1_u10purec(x); }
double atanh(double x) { return Sleef_cinz_atanhd1_u10purec(x); }
double erf(double x) { return Sleef_cinz_erfd1_u10purec(x); }
double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }
double lgamma(double x) { return Sleef_cinz_lgammad1_u10purec(x); }
double tgamma(double x) { return Sleef_cinz_tgammad1_u10purec(x); }

/* What compilers make of a sine beside a cosine. */
void sincos(double x, double *sine, double *cosine);
void sincos(double x, double *sine, double *cosine) {
  *sine = Sleef_cinz_sind1_u35purec(x);
  *cosine = Sleef_cinz_cosd1_u35purec(x);
}
