"""The conformance kit, on every toy world."""

from grammarbt.testing import DomainConformance, DomainSubject


class TestTaskSelection(DomainConformance):
    subject = DomainSubject("taskselection", {"conditions": 4})


class TestAnt(DomainConformance):
    subject = DomainSubject("ant")


class TestForaging(DomainConformance):
    subject = DomainSubject("foraging", {"steps": 100})


class TestPlatformer(DomainConformance):
    subject = DomainSubject("platformer")
