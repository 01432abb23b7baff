"""How answers and silence narrow down the models that a module can be."""

from i7000 import Model
from i7000.host.procedures import Candidate
from i7000.host.procedures.evidence import Evidence

TWO = Evidence.of((Model.I_7018, Model.M_7018), "the name")


def test_an_answer_rules_out_the_models_that_do_not_have_it() -> None:
    assert TWO.only({Model.M_7018}, "it") == Evidence((Candidate(Model.M_7018),), ("the name", "it: not I-7018"))


def test_what_all_candidates_have_says_nothing() -> None:
    assert TWO.only(set(Model), "it") is TWO


def test_what_no_candidate_has_is_noted_and_rules_nothing_out() -> None:
    assert TWO.only({Model.I_7017}, "it") == Evidence(TWO.candidates, ("the name", "it, but this contradicts the rest"))


def test_a_doubt_puts_a_model_behind_the_others() -> None:
    assert TWO.doubt({Model.I_7018}, "silence").candidates == (
        Candidate(Model.M_7018),
        Candidate(Model.I_7018, ("silence",)),
    )


def test_the_only_candidate_can_be_doubted() -> None:
    one = TWO.only({Model.M_7018}, "it")

    assert one.alone("its name").candidates == (Candidate(Model.M_7018, ("its name",)),)
    assert TWO.alone("its name") is TWO


def test_a_doubt_about_every_candidate_says_nothing() -> None:
    assert TWO.doubt(set(Model), "silence") is TWO
