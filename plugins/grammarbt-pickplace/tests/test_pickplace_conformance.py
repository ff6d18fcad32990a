"""The conformance kit, on every task."""

from grammarbt.testing import DomainConformance, DomainSubject


class TestS1(DomainConformance):
    subject = DomainSubject("pickplace")


class TestS2(DomainConformance):
    subject = DomainSubject("pickplace", {"task": "S2"})


class TestS3(DomainConformance):
    subject = DomainSubject("pickplace", {"task": "S3", "stochastic": True})
