// SPDX-License-Identifier: MIT
// A machine whose int has 16 bits, on one whose int has more: integers that are
// promoted and converted as C does there, so that primitives.c can try all
// operands at this machine's speed. A signed sum, difference or product that
// does not fit, and a shift by too much, end the program: C leaves them
// undefined. What stands in namespace int16 sees these types instead of those
// of <stdint.h>.
#ifndef INT16_HH
#define INT16_HH
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace int16
{

[[noreturn]] inline void undefined(const char *what)
{
    std::printf("with an int of 16 bits: %s\n", what);
    std::exit(1);
}

// What an operator gives, which becomes a Word of any size as in C: the mask of
// a byte may be an argument. `?:` has one meaning then, as no Word becomes one.
template <int BITS, bool SIGNED> struct Result;

template <int BITS, bool SIGNED> struct Word {
    using Signed = std::conditional_t<
        BITS == 8, std::int8_t,
        std::conditional_t<BITS == 16, std::int16_t, std::int32_t>>;
    using Type =
        std::conditional_t<SIGNED, Signed, std::make_unsigned_t<Signed>>;
    static constexpr int bits = BITS;
    static constexpr bool is_signed = SIGNED;

    Type value;

    Word() = default;
    template <class T, class = std::enable_if_t<std::is_integral_v<T>>>
    Word(T number) : value(static_cast<Type>(number))
    {
    }
    template <int FROM, bool SIGN>
    Word(Result<FROM, SIGN> other) : Word(other.word.value)
    {
    }
    // A cast is needed where a variable's value may change.
    template <int FROM, bool SIGN>
    explicit(!((FROM < BITS) && (SIGNED || !SIGN))) Word(Word<FROM, SIGN> other)
        : value(static_cast<Type>(other.value))
    {
    }
    // For primitives.c only: to no other type, so that `?:` has one meaning.
    template <class T,
              class = std::enable_if_t<std::is_same_v<T, std::int64_t>>>
    operator T() const
    {
        return value;
    }

#define INT16_ASSIGNMENT(op)                                                   \
    template <class T> Word &operator op##=(T other)                           \
    {                                                                          \
        return *this = *this op other;                                         \
    }
    INT16_ASSIGNMENT(+)
    INT16_ASSIGNMENT(-)
    INT16_ASSIGNMENT(^)
    INT16_ASSIGNMENT(|)
    INT16_ASSIGNMENT(<<)
    INT16_ASSIGNMENT(>>)

    Word operator--(int)
    {
        const Word was = *this;

        *this -= 1;
        return was;
    }
};

template <int BITS, bool SIGNED> struct Result {
    Word<BITS, SIGNED> word;

    template <class T,
              class = std::enable_if_t<std::is_same_v<T, std::int64_t>>>
    operator T() const
    {
        return word.value;
    }
};

// The integer promotions. What is an int of this machine is a literal.
template <class T> auto promoted(T literal)
{
    const Word<16, std::is_signed_v<T> || std::is_same_v<T, bool>> word(
        literal);

    static_assert(sizeof literal <= sizeof(int));
    if (static_cast<std::int64_t>(word) != static_cast<std::int64_t>(literal)) {
        undefined("a constant is no int");
    }
    return word;
}

template <int BITS, bool SIGNED> auto promoted(Word<BITS, SIGNED> word)
{
    if constexpr (BITS < 16) {
        return Word<16, true>(word.value);
    } else {
        return word;
    }
}

template <int BITS, bool SIGNED> auto promoted(Result<BITS, SIGNED> result)
{
    return result.word;
}

template <class T> using Promoted = decltype(promoted(T()));

// The usual arithmetic conversions.
template <class A, class B> struct Usual {
    using P = Promoted<A>;
    using Q = Promoted<B>;
    using Type = std::conditional_t<
        (P::bits > Q::bits), P,
        std::conditional_t<(Q::bits > P::bits), Q,
                           Word<P::bits, P::is_signed && Q::is_signed>>>;
};

template <class A> struct IsWord : std::false_type {
};
template <int BITS, bool SIGNED>
struct IsWord<Word<BITS, SIGNED>> : std::true_type {
};
template <int BITS, bool SIGNED>
struct IsWord<Result<BITS, SIGNED>> : std::true_type {
};

template <class A, class B>
using Common = typename std::enable_if_t<IsWord<A>::value || IsWord<B>::value,
                                         Usual<A, B>>::Type;

template <class To> using ResultOf = Result<To::bits, To::is_signed>;

template <class To> ResultOf<To> fitting(std::int64_t result)
{
    const To word(result);

    if (To::is_signed && (word.value != result)) {
        undefined("a signed result does not fit");
    }
    return {word};
}

template <class To, class A> std::int64_t as(A operand)
{
    return To(promoted(operand)).value;
}

#define INT16_ARITHMETIC(op)                                                   \
    template <class A, class B, class To = Common<A, B>>                       \
    ResultOf<To> operator op(A a, B b)                                         \
    {                                                                          \
        return fitting<To>(as<To>(a) op as<To>(b));                            \
    }
INT16_ARITHMETIC(+)
INT16_ARITHMETIC(-)
INT16_ARITHMETIC(*)
INT16_ARITHMETIC(&)
INT16_ARITHMETIC(|)
INT16_ARITHMETIC(^)

#define INT16_COMPARISON(op)                                                   \
    template <class A, class B, class To = Common<A, B>>                       \
    bool operator op(A a, B b)                                                 \
    {                                                                          \
        return as<To>(a) op as<To>(b);                                         \
    }
INT16_COMPARISON(==)
INT16_COMPARISON(!=)
INT16_COMPARISON(<)
INT16_COMPARISON(<=)
INT16_COMPARISON(>)
INT16_COMPARISON(>=)

template <class A, class B, class = Common<A, B>>
ResultOf<Promoted<A>> operator<<(A a, B b)
{
    const std::int64_t places = promoted(b).value;

    if ((places < 0) || (places >= Promoted<A>::bits)) {
        undefined("a shift by too much");
    }
    return fitting<Promoted<A>>(static_cast<std::int64_t>(promoted(a).value)
                                << places);
}

template <class A, class B, class = Common<A, B>>
ResultOf<Promoted<A>> operator>>(A a, B b)
{
    const std::int64_t places = promoted(b).value;

    if ((places < 0) || (places >= Promoted<A>::bits)) {
        undefined("a shift by too much");
    }
    return {Promoted<A>(promoted(a).value >> places)};
}

template <class A, class = std::enable_if_t<IsWord<A>::value>>
ResultOf<Promoted<A>> operator~(A a)
{
    return {Promoted<A>(~promoted(a).value)};
}

template <class A, class = std::enable_if_t<IsWord<A>::value>>
ResultOf<Promoted<A>> operator-(A a)
{
    return fitting<Promoted<A>>(-as<Promoted<A>>(a));
}

typedef Word<8, true> int8_t;
typedef Word<8, false> uint8_t;
typedef Word<16, true> int16_t;
typedef Word<16, false> uint16_t;
typedef Word<32, true> int32_t;
typedef Word<32, false> uint32_t;
typedef uint8_t uint_fast8_t;
typedef uint16_t uint_fast16_t;
typedef int16_t int_fast16_t;

} // namespace int16

// Those of <stdint.h> and <climits> that are no int there. The headers in src/
// choose their form by the first one.
#undef INT_MAX
#undef UINT16_MAX
#undef INT32_MIN
#undef INT32_MAX
#undef UINT32_C
#undef INT32_C
#define INT_MAX 32767
#define UINT16_MAX int16::uint16_t(65535)
#define INT32_MIN int16::int32_t(-2147483647 - 1)
#define INT32_MAX int16::int32_t(2147483647)
#define UINT32_C(number) int16::uint32_t(number##u)
#define INT32_C(number) int16::int32_t(number)

#endif
