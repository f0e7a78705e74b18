#pragma once

#include <type_traits>

namespace railwave {

/// Types that the program chooses from when a model is built.
template <class... Types>
struct TypeList {};

/// A type as a value.
template <class T>
struct TypeOf {
  using type = T;
};

/// The place of a type in a list; that of the end where it is not there.
template <class T, class... Types>
constexpr int type_number(TypeList<Types...> /*list*/) {
  int number = 0;
  ((std::is_same_v<T, Types> || (++number, false)) || ...);
  return number;
}

template <class T, class... Types>
constexpr bool is_listed(TypeList<Types...> /*list*/) {
  return (std::is_same_v<T, Types> || ...);
}

/// Calls `work(number, TypeOf<...>)` for each type of a list, on the host.
template <class Work, class... Types>
void for_each_type(TypeList<Types...> /*list*/, const Work& work) {
  int number = 0;
  (work(number++, TypeOf<Types>{}), ...);
}

/// The number of the first type of a list for which `is(TypeOf<...>)` holds; -1: none.
template <class List, class Is>
int first_type(List list, const Is& is) {
  int first = -1;
  for_each_type(list, [&](int number, auto type) {
    if (first < 0 && is(type)) first = number;
  });
  return first;
}

/// Calls `work(TypeOf<...>)` for the type that has the number in the list.
template <class List, class Work>
void with_type(List list, int number, const Work& work) {
  for_each_type(list, [&](int of_type, auto type) {
    if (of_type == number) work(type);
  });
}

}  // namespace railwave
