"""A block of N x N x N unit bricks as a keyword deck, for timing the reader: make_brick_deck.py N DECK"""

import sys


def main(count, path):
    side = count + 1
    with open(path, "w") as deck:
        deck.write("*KEYWORD\n*CONTROL_TERMINATION\n       1.0\n*PART\nblock\n         1         1         1\n")
        deck.write("*SECTION_SOLID\n         1         1\n*MAT_ELASTIC\n         1    7.8E-6     210.0       0.3\n")
        deck.write("*NODE\n")
        number = 0
        for k in range(side):
            for j in range(side):
                rows = []
                for i in range(side):
                    number += 1
                    rows.append(f"{number:8d}{i * 1.00173:16.8f}{j * 0.99871:16.8f}{k * 1.01013:16.8f}\n")
                deck.write("".join(rows))
        deck.write("*ELEMENT_SOLID\n")
        number = 0
        layer = side * side
        for k in range(count):
            for j in range(count):
                rows = []
                for i in range(count):
                    number += 1
                    a = 1 + i + j * side + k * layer
                    b = a + side
                    rows.append(
                        f"{number:8d}{1:8d}{a:8d}{a + 1:8d}{b + 1:8d}{b:8d}"
                        f"{a + layer:8d}{a + layer + 1:8d}{b + layer + 1:8d}{b + layer:8d}\n"
                    )
                deck.write("".join(rows))
        deck.write("*END\n")


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
