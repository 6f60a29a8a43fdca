"""Step 1: a serial particle code."""
from particles import NUM_STEPS, column_of_water, count_pairs, move

x = column_of_water()
pairs = 0.0
for step in range(NUM_STEPS):
    pairs += count_pairs(x, x)
    move(x)
print(f"{pairs:.0f} pairs")

# Output of any run:
# 1605164 pairs
