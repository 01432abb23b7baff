"""What is wrong with a frame, as ``i7000 decode`` prints it for people."""

import pytest

from tests.terminal import Run


@pytest.mark.parametrize(
    ("frame", "note"),
    [
        ("$012", "without a checksum it is ReadConfiguration; the checksum would be B7"),
        ("$012B6", "B6 in place of a checksum? that of ReadConfiguration would be B7"),
    ],
)
def test_one_line_says_what_the_checksum_of_a_frame_would_be(run: Run, frame: str, note: str) -> None:
    result = run("decode", "--checksum", frame)

    assert result.out == (
        f"1    {frame}\n     not understood: the checksum is missing or wrong\n       note            {note}\n"
    )


def test_a_wrong_checksum_of_an_unknown_frame_is_shown_with_the_right_one(run: Run) -> None:
    assert "not understood: checksum at byte 4; allowed: DF\n" in run("decode", "--checksum", "$01ZZZ").out
