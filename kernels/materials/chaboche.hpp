#pragma once

#include "kernels/materials/flow_history.hpp"

namespace railwave {

struct ChabocheConstants {
  ElasticConstants elastic;
  double yield_stress;  ///< sigma_y, Pa, von Mises, at the first yield
  double saturation;    ///< Q, Pa
  double rate;          ///< b
  double back_modulus;  ///< C, Pa
  double recall;        ///< gamma
};

/// Hardening that saturates, of the yield surface's size (Voce) and of its place (Armstrong and Frederick): the law of
/// cyclic plasticity and ratchetting (Armstrong and Frederick 1966; Lemaitre and Chaboche 1990, 5.4).
///   k(p) = sigma_y + Q (1 - exp(-b p)),   db = 2/3 C de_p - gamma b dp,   q(s - b) <= k(p), q = sqrt(3/2 x : x)
/// The return is backward Euler. With N the direction of s - b at its end, q(N) = 1, and t = 1/(1 + gamma dp),
///   b' = t (b + C dp N),  s' = s - 3 mu dp N,  so that  q(s - t b) - (3 mu + t C) dp = k(p + dp),
/// which Newton's method solves for dp.
struct Chaboche : BackStressHistory<ChabocheConstants, 14> {
  static constexpr int flow_work = 13;  ///< of the history: work of the flow so far, J/m3
  static constexpr int iterations = 6;  ///< from the tangent at no flow; steps that flow by a yield strain take four

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void stress(const OfBlock<S>& block, int batch, const T (&K)[3][3], T (&e)[6],
                                          T (&tau)[6]) const {
    const Constants& material = block.constants;
    T h[6], s[6], back[6], xi[6], turned[3][3];
    leave_elastic_part<S>(block, batch, K, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(material.elastic, h, tau);
    deviator<S>(tau, s);
    const T flowed = equivalent<S>(batch);
    // As long as nothing has flowed there is no back stress either.
    const bool has_flowed = any_lane(flowed > S(0));
    for (int c = 0; c < 6; ++c) back[c] = S(0);
    if (has_flowed) {
      turn_back<S>(block, K, turned);
      load_back<S>(batch, turned, back);
    }
    for (int c = 0; c < 6; ++c) xi[c] = s[c] - back[c];
    const T trial_square = mises_square<S>(xi), limit = flow_stress<S>(material, flowed);
    const auto yields = trial_square > limit * limit;
    if (!any_lane(yields)) return;

    const T increment = flow_increment<S>(material, yields, s, back, trial_square, flowed, limit);
    const T left = S(1) / (S(1) + S(material.recall) * increment);  // t
    for (int c = 0; c < 6; ++c) xi[c] = s[c] - left * back[c];
    const T size = choose(yields, square_root(mises_square<S>(xi)), T(S(1)));
    T lost[6], added[6];
    const T along = S(1.5) * increment / size;
    for (int c = 0; c < 6; ++c) {
      lost[c] = along * xi[c];
      added[c] = left * (S(2.0 / 3 * material.back_modulus) * lost[c] - S(material.recall) * increment * back[c]);
      tau[c] -= S(2 * material.elastic.mu) * lost[c];
    }
    // Both ends of the way: the surface's size, and its place along the flow.
    const T limit_after = flow_stress<S>(material, T(flowed + increment));
    T place[6];
    for (int c = 0; c < 6; ++c) place[c] = back[c] + S(0.5) * added[c];
    const T work_density = S(0.5) * (limit + limit_after) * increment + product(place, lost);

    book_flow<S, false>(block, batch, K, e, yields, lost, increment);
    if (!has_flowed) turn_back<S>(block, K, turned);
    add_back<S>(batch, turned, added);
    add_to_history<S>(value<S>(batch, flow_work), work_density);
  }

  KOKKOS_INLINE_FUNCTION static double work(const Constants& /*constants*/, const double (&history)[history_values]) {
    return history[flow_work];
  }

 private:
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION static T product(const T (&a)[6], const T (&b)[6]) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]) +
           (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
  }

  /// 3/2 a : b
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static T mises_product(const T (&a)[6], const T (&b)[6]) {
    return S(1.5) * product(a, b);
  }

  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION static T exponential(const T& value) {
    using std::exp;
    return T(exp(value));
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static T flow_stress(const Constants& material, const T& flowed) {
    return S(material.yield_stress) + S(material.saturation) * (S(1) - exponential(T(S(-material.rate) * flowed)));
  }

  /// dp; zero in lanes that do not yield.
  template <class S, class T, class Mask>
  KOKKOS_FORCEINLINE_FUNCTION static T flow_increment(const Constants& material, const Mask& yields, const T (&s)[6],
                                                      const T (&back)[6], const T& trial_square, const T& flowed,
                                                      const T& limit) {
    const S three_mu = S(3 * material.elastic.mu), modulus = S(material.back_modulus), recall = S(material.recall);
    const T ss = mises_product<S>(s, s), sb = mises_product<S>(s, back), bb = mises_product<S>(back, back);
    // Ahead of where straight lines would lead, for hardening only slows: Newton's method comes from one side.
    T dp = choose(yields, T((square_root(trial_square) - limit) / (three_mu + modulus)), T(S(0)));
    for (int k = 0; k < iterations; ++k) {
      const T left = S(1) / (S(1) + recall * dp);
      const T q = choose(yields, square_root(T(ss - S(2) * left * sb + left * left * bb)), T(S(1)));
      const T softening = exponential(T(S(-material.rate) * (flowed + dp)));
      const T now = S(material.yield_stress) + S(material.saturation) * (S(1) - softening);
      const T miss = q - (three_mu + left * modulus) * dp - now;
      const T slope = (sb - left * bb) * recall * left * left / q - three_mu - modulus * left * left -
                      S(material.saturation * material.rate) * softening;
      dp = choose(yields, T(dp - miss / slope), T(S(0)));
    }
    return choose(dp > S(0), dp, T(S(0)));
  }
};

}  // namespace railwave
