"""What is learned from the responses of modules, and how long it holds.

A fact that a response states, a setting that was read or changed, replaces what was known before. Another name, series
or firmware is that of another module: nothing that was learned before holds for it. A response that does not fit a
learned fact is a contradiction, and the fact still holds: it is dropped when another one contradicts it before one of
the same kind has fitted. A write to all modules is taken to hold for each that has the register (E94).
"""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from operator import is_

from attrs import evolve, fields

from i7000.dissect.exchanges import TEACHING, address_of_all, broadcast_facts, facts_of, new_address
from i7000.dissect.known import Fact, Knowledge, Known, Module, Origin, fact_words, lacking_type
from i7000.dissect.meaning import Meaning

__all__ = ["doubt", "learn", "learn_from_broadcast", "trust", "with_facts"]


_REMEMBERED = 256
"""The number of answers for which the cache keeps whether they show something new."""


def learn(
    knowledge: Knowledge, address: int, meaning: Meaning, where: str, shown: tuple[str, ...] = ()
) -> tuple[Knowledge, tuple[str, ...]]:
    """Learn from a response of the module at an address; and return what of it contradicts what was known before.

    Shape: `where` it stands; `shown`, the facts that its form alone shows.
    """
    if not shown and type(meaning.command) not in TEACHING:
        return knowledge, ()
    module = knowledge.of(address)
    moved = new_address(meaning)
    if moved in (None, address) and not _has_news(meaning, module, shown):
        return knowledge, ()
    learned, wrong = _learned(module, _all_facts(meaning, module, shown, where))
    if learned is not module:
        knowledge = knowledge.put(address, learned)
    if moved not in (None, address):
        knowledge = knowledge.move(address, moved)
    return knowledge, tuple(wrong)


def _learned(module: Module, facts: Iterable[Fact]) -> tuple[Module, list[str]]:
    """Return a module with these facts, and what of them contradicts what was known."""
    facts = tuple(facts)
    wrong = [said for fact in facts if (said := _contradiction(module, module.facts.get(fact.name), fact))]
    is_other = any(_is_of_another(module.facts.get(fact.name), fact) for fact in facts)
    learned = Module(module.given) if is_other else module
    for fact in facts:
        before = learned.facts.get(fact.name)
        if _is_new(before, fact):
            if before is not None and before.changed:
                fact = evolve(fact, changed=True)  # noqa: PLW2901 - what was given does not come back
            after = learned.learn(fact)
            if after is learned:
                wrong.append(_impossible(learned, fact))
            learned = after
    return learned, wrong


def _is_of_another(before: Fact | None, fact: Fact) -> bool:
    """Return whether a fact is that of another module than the one that was there before."""
    return before is not None and fact.name in _NAMING and not fact.changed and not _agree(before, fact)


@lru_cache(maxsize=_REMEMBERED)
def _has_news(meaning: Meaning, module: Module, shown: tuple[str, ...]) -> bool:
    """Return whether a response shows anything that is new, or contradicts what is known."""
    for fact in _all_facts(meaning, module, shown, ""):
        before = module.facts.get(fact.name)
        if _is_new(before, fact) or _contradiction(module, before, fact):
            return True
    return False


def _all_facts(meaning: Meaning, module: Module, shown: tuple[str, ...], where: str) -> Iterator[Fact]:
    """Yield what a response shows, by its fields or by its form."""
    facts = {fact.name: fact for fact in facts_of(meaning, module.known, where)}
    profile = meaning.fit.profiles[0]
    facts |= {name: Fact(name, getattr(profile, name), where=where) for name in shown}
    name = module.facts.get("name")
    if name is not None and name.changed:
        facts.pop("models", None)  # A name that was set does not show the model.
    yield from facts.values()


def _is_new(before: Fact | None, fact: Fact) -> bool:
    """Return whether a fact adds anything: a change is one once only, and what is shown again is in doubt no more."""
    return (
        before is None
        or before.value != fact.value
        or fact.changed > before.changed
        or before.origin is not fact.origin
        or before.doubted_by != ""
    )


_NAMING = ("name", "firmware", "models")
"""Facts that no setting changes, or hardly ever."""


def _contradiction(module: Module, before: Fact | None, fact: Fact) -> str | None:
    """Return what a response contradicts; an accepted change contradicts nothing."""
    if fact.changed:
        return None
    model = module.given.model
    if fact.name == "models" and model is not None:
        return None if model in fact.value else f"{fact_words(fact)} by its name, but an {model.value} was given"
    if module.gives(fact.name) and not (before is not None and before.changed):
        given = evolve(fact, value=getattr(module.given, fact.name))
        return None if _agree(given, fact) else f"{fact_words(fact)}, but {fact_words(given)} was given"
    if before is None or before.value is None or before.doubted_by or _agree(before, fact):
        return None
    if before.origin is Origin.ASSUMED:
        return f"{fact_words(fact)}, but the broadcast of {before.where} set {fact_words(before)}"
    other = "; two modules on one address?" if fact.name in _NAMING else ""
    return f"{fact_words(fact)}, but {before.where} said {fact_words(before)}{other}"


def _agree(one: Fact, other: Fact) -> bool:
    """Return whether two facts of one name can both be true: of types, where both are known."""
    if one.name == "models":
        return not set(one.value).isdisjoint(other.value)
    if one.name != "types":
        return bool(one.value == other.value)
    if 1 in (len(one.value), len(other.value)):  # The type of all channels.
        known, others = set(one.value) - {None}, set(other.value) - {None}
        return known == others or not known or not others
    return all(None in pair or pair[0] == pair[1] for pair in zip(one.value, other.value, strict=False))


def _impossible(module: Module, fact: Fact) -> str:
    """Return a note that no module has what was shown together with what is known."""
    known = module.known
    lacking = fact.name == "types" and next(filter(None, (lacking_type(known, code) for code in fact.value)), None)
    if lacking:
        return f"{lacking}; another model?"
    others = (Fact(it.name, getattr(known, it.name)) for it in fields(Known) if it.name != fact.name)
    words = " and ".join(fact_words(other) for other in others if other.value not in (None, ()))
    return f"{fact_words(fact)} does not go with {words}"


def doubt(module: Module, names: Iterable[str], kind: str) -> Module:
    """Doubt learned facts that a response of this kind contradicts; drop those that were in doubt before."""
    facts = dict(module.facts)
    for name in names:
        fact = facts.pop(name)
        if not fact.doubted_by:
            facts[name] = evolve(fact, doubted_by=kind)
    return Module(module.given, facts)


def trust(module: Module, kind: str) -> Module:
    """Take the doubts away that a response of this kind raised, because one has come that fits."""
    if all(fact.doubted_by != kind for fact in module.facts.values()):
        return module
    trusted = {name: evolve(it, doubted_by="") if it.doubted_by == kind else it for name, it in module.facts.items()}
    return Module(module.given, trusted)


def learn_from_broadcast(knowledge: Knowledge, meaning: Meaning, where: str) -> Knowledge:
    """Learn what a write to all modules sets in each of them, which is assumed: no module confirms it (E94).

    Special: a value is unknown afterwards if it depends on the model, and the model is unknown. The only known module
        is known at a new address too. Of several modules none moves, as one address cannot be that of all.
    """
    others = _told(knowledge.others, meaning, where)
    modules = {address: _told(module, meaning, where) for address, module in knowledge.modules.items()}
    if len(modules) == 1:
        (module,) = modules.values()
        moved = address_of_all(meaning.message, module.known)
        modules |= {} if moved is None else {moved: module}
    before = (knowledge.others, *knowledge.modules.values())
    is_same = len(modules) == len(knowledge.modules) and all(map(is_, before, (others, *modules.values())))
    return knowledge if is_same else Knowledge(others, modules)


def _told(module: Module, meaning: Meaning, where: str) -> Module:
    for name, value in broadcast_facts(meaning.message, module.known):
        fact = Fact(name, value, Origin.ASSUMED, where, changed=True)
        known = Fact(name, getattr(module.known, name) if module.gives(name) else None)
        before = next((it for it in module.learned if it.name == name), known)
        if before.value is None or value is None or not _agree(before, fact):
            module = module.learn(fact)
    return module


def with_facts(meaning: Meaning, module: Module) -> Meaning:
    """Return a meaning whose facts name the frame that showed them."""
    learned = {fact.name: fact for fact in module.learned}
    facts = tuple(learned.get(fact.name, fact) for fact in meaning.facts)
    return meaning if facts == meaning.facts else evolve(meaning, facts=facts)
