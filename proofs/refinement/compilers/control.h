/* Statements of the subset that Semantics.v knows, for the comparison with compilers. */

static inline uint64_t control_sum(uint64_t count, uint64_t start) {
    uint64_t sum = start;
    for (uint64_t i = 0; i < count % 50; ++i) sum += i * start;
    return sum;
}

static inline uint64_t control_break(uint64_t limit, uint64_t step) {
    uint64_t i = 0;
    while (true) {
        if (i >= limit % 40) break;
        i += step % 7 + 1;
    }
    return i;
}

static inline uint64_t control_continue(uint64_t count, uint64_t divisor) {
    uint64_t odd = 0;
    for (uint64_t i = 0; i != count % 30; i++) {
        if (i % (divisor % 5 + 1) == 0) continue;
        const uint64_t square = i * i;
        odd = odd * 3 + square;
    }
    return odd;
}

static inline uint64_t control_return(uint64_t sought, uint64_t step) {
    for (uint64_t i = 0; i < 60; ++i) {
        for (uint64_t j = 0; j < 3; ++j) {
            if (i * 3 + j == sought % 200) return i * 1000 + j;
        }
        if (step % 11 == i) return 7;
    }
    return 0;
}

static inline uint64_t control_shadow(uint64_t a, uint64_t b) {
    uint64_t x = a;
    {
        uint64_t y = b;
        if (y > x) {
            const uint64_t x = y - 1;
            y = x * 2;
        }
        a = y;
    }
    const uint64_t z = x ^ a;
    return z;
}

static inline uint8_t control_small(uint8_t a, uint8_t b) {
    uint8_t x = a;
    x += b;
    ++x;
    x = (uint8_t)(x << 1);
    x--;
    x ^= b;
    x |= 1;
    x >>= 1;
    return x;
}

static inline bool control_short(uint64_t a, uint64_t b) {
    return (b != 0 && a / b > 3) || (a == 0 ? b > 1 : a % 3 == 1);
}

static inline uint64_t control_call(uint64_t a, uint64_t b) {
    if (control_short(a, b)) return control_sum(a, b);
    return control_small((uint8_t)a, (uint8_t)control_break(a, b)) + 1;
}

static inline int64_t control_signed(int32_t a, int16_t b) {
    int32_t i = a;
    i -= b;
    if (!(i > 0)) i = -i;
    return i * (int64_t)b / 3;
}

struct control_pair {
    uint16_t low;
    int64_t high;
};

static inline int64_t control_of(struct control_pair pair) {
    pair.low += 1;
    return pair.high - pair.low;
}

/* On memory: `pair` is an array of two. */
static inline uint64_t memory_swap(uint64_t* pair) {
    const uint64_t first = pair[0];
    pair[0] = pair[1];
    pair[1] = first;
    *pair += 5;
    return pair[0] * 3 + pair[1];
}

static inline uint64_t memory_walk(uint64_t* pair) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < 2; ++i) {
        pair[i] ^= sum;
        sum += pair[i] / 2;
        if (pair[1] > pair[0]) --pair[0];
    }
    return memory_swap(pair) ^ sum;
}

static inline uint64_t memory_call(uint64_t* pair) {
    const uint64_t before = *pair;
    pair[0] = memory_walk(pair);
    return before + pair[0] - pair[1];
}
