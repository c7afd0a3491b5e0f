// Ids as numbers that grow with the primitive, for minima and maxima: 1 … 0xFFFFFFFE, so that 0 is below all of them and 0xFFFFFFFF above.
// They are integers throughout: the papers blend them as floats, which hold no id above 2^24.
#define ORDER_BELOW 0u
#define ORDER_ABOVE 0xFFFFFFFFu

uint orderOfId(uint id) { return (id << 1 | id >> 31) + 1u; }

uint idOfOrder(uint order) { return (order - 1u) >> 1 | (order - 1u) << 31; }
