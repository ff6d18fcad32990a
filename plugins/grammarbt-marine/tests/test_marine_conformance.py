from grammarbt.testing import DomainConformance, DomainSubject


class TestMarine(DomainConformance):
    subject = DomainSubject("marine")


class TestScheide(DomainConformance):
    subject = DomainSubject("marine", {"preset": "scheide"})
