"""The works that this program stands on: who, what, where, and what each serves here."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Work:
    """One publication."""

    key: str
    authors: tuple[str, ...]
    title: str
    where: str  # journal or proceedings
    year: int
    serves: str  # what we use it for
    volume: str = ""
    number: str = ""
    doi: str = ""
    of: tuple[str, ...] = ()  # commands whose trees it serves; none: all
    only: str = ""  # of those, runs with this mark (`citations.marks_of`); none: all

    @property
    def line(self) -> str:
        """One line of text."""
        place = ", ".join(part for part in (self.where, f"{self.volume} ({self.number})" if self.number else self.volume) if part)
        return f"{', '.join(self.authors)} ({self.year}): {self.title}. {place}." + (f" https://doi.org/{self.doi}" if self.doi else "")

    @property
    def bibtex(self) -> str:
        """An entry for BibTeX."""
        kind, holder = ("inproceedings", "booktitle") if self.where.startswith("Proceedings") else ("article", "journal")
        fields = {"author": " and ".join(self.authors), "title": f"{{{self.title}}}", holder: self.where, "year": str(self.year)}
        fields |= {name: value for name, value in (("volume", self.volume), ("number", self.number), ("doi", self.doi)) if value}
        body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items())
        return f"@{kind}{{{self.key},\n{body}\n}}"


_TOG, _TPAMI, _CGF = "ACM Transactions on Graphics", "IEEE Transactions on Pattern Analysis and Machine Intelligence", "Computer Graphics Forum"
_DRAWN = ("build", "forest", "batch", "infer", "inspect", "studio", "photo", "grow")
_POINTS = ("cloud", "views")
MEASURES = ("measures",)
"""Of works by which trees are measured, or against which: no command makes a tree by them."""

WORKS = (
    Work("chen2008sketch", ("Xuejin Chen", "Boris Neubert", "Ying-Qing Xu", "Oliver Deussen", "Sing Bing Kang"),
         "Sketch-Based Tree Modeling Using Markov Random Field", _TOG, 2008,
         "reading depths off a sketch, templates, replication blocks; `--method chen`", "27", "5", of=_DRAWN),
    Work("tan2008single", ("Ping Tan", "Tian Fang", "Jianxiong Xiao", "Peng Zhao", "Long Quan"),
         "Single Image Tree Modeling", _TOG, 2008,
         "`sketchtree photo`: foliage, tracing, growth by attractors", "27", "5", of=("photo",)),
    Work("okabe2005interactive", ("Makoto Okabe", "Shigeru Owada", "Takeo Igarashi"),
         "Interactive Design of Botanical Trees Using Freehand Sketches and Example-Based Editing", _CGF, 2005,
         "`--method okabe`", "24", "3", only="okabe"),
    Work("guo2018realistic", ("Jianwei Guo", "Shibiao Xu", "Dong-Ming Yan", "Zhanglin Cheng", "Marc Jaeger", "Xiaopeng Zhang"),
         "Realistic Procedural Plant Modeling from Multiple View Images", "IEEE Transactions on Visualization and Computer Graphics", 2018,
         "`sketchtree views` and `sketchtree cloud`: depth from photos, roots, trunks, thickness, growth toward points", doi="10.1109/TVCG.2018.2869784", of=_POINTS),
    Work("verroust2000extracting", ("Anne Verroust", "Francis Lazarus"),
         "Extracting Skeletal Curves from 3D Scattered Data", "The Visual Computer", 2000,
         "`--method traced`: layers of points that are equally far from the foot", "16", "1", "10.1007/PL00007210", of=_POINTS, only="traced"),
    Work("palubicki2009self", ("Wojciech Pałubicki", "Kipp Horel", "Steven Longay", "Adam Runions", "Brendan Lane", "Radomír Měch", "Przemyslaw Prusinkiewicz"),
         "Self-Organizing Tree Models for Image Synthesis", _TOG, 2009,
         "`--method grown`: what a bud perceives", "28", "3", "10.1145/1531326.1531364", of=_POINTS, only="grown"),
    Work("runions2007modeling", ("Adam Runions", "Brendan Lane", "Przemyslaw Prusinkiewicz"),
         "Modeling Trees with a Space Colonization Algorithm", "Proceedings of the Eurographics Workshop on Natural Phenomena", 2007,
         "`--method grown`: growth that uses up points; as printed, what ours is held against", doi="10.2312/NPH/NPH07/063-070", of=_POINTS, only="grown"),
    Work("schoenberger2016structure", ("Johannes L. Schönberger", "Jan-Michael Frahm"),
         "Structure-from-Motion Revisited", "Proceedings of the IEEE Conference on Computer Vision and Pattern Recognition", 2016,
         "COLMAP: where photos were taken from", doi="10.1109/CVPR.2016.445", of=("views",), only="placed"),
    Work("bleyer2011patchmatch", ("Michael Bleyer", "Christoph Rhemann", "Carsten Rother"),
         "PatchMatch Stereo - Stereo Matching with Slanted Support Windows", "Proceedings of the British Machine Vision Conference", 2011,
         "the plane that each pixel shows", doi="10.5244/C.25.14", of=("views",), only="patchmatch"),
    Work("schoenberger2016pixelwise", ("Johannes L. Schönberger", "Enliang Zheng", "Jan-Michael Frahm", "Marc Pollefeys"),
         "Pixelwise View Selection for Unstructured Multi-View Stereo", "Proceedings of the European Conference on Computer Vision", 2016,
         "bilateral weights within a patch", doi="10.1007/978-3-319-46487-9_31", of=("views",), only="patchmatch"),
    Work("vedaldi2008quick", ("Andrea Vedaldi", "Stefano Soatto"),
         "Quick Shift and Kernel Methods for Mode Seeking", "Proceedings of the European Conference on Computer Vision", 2008,
         "segments of one plane each", doi="10.1007/978-3-540-88693-8_52", of=("views",), only="patchmatch"),
    Work("lempitsky2010fusion", ("Victor Lempitsky", "Carsten Rother", "Stefan Roth", "Andrew Blake"),
         "Fusion Moves for Markov Random Field Optimization", _TPAMI, 2010,
         "the best mixture of several depth maps", "32", "8", "10.1109/TPAMI.2009.143", of=("views",), only="coherence"),
    Work("rother2005digital", ("Carsten Rother", "Sanjiv Kumar", "Vladimir Kolmogorov", "Andrew Blake"),
         "Digital Tapestry", "Proceedings of the IEEE Conference on Computer Vision and Pattern Recognition", 2005,
         "pairs that a cut can't tell", doi="10.1109/CVPR.2005.130", of=("views",), only="coherence"),
    Work("he2013guided", ("Kaiming He", "Jian Sun", "Xiaoou Tang"),
         "Guided Image Filtering", _TPAMI, 2013,
         "depths that are smooth but for the photo's edges", "35", "6", "10.1109/TPAMI.2012.213", of=("views",), only="filter"),
    Work("laurentini1994visual", ("Aldo Laurentini",),
         "The Visual Hull Concept for Silhouette-Based Image Understanding", _TPAMI, 1994,
         "points of masks", "16", "2", "10.1109/34.273735", of=("views",), only="carve"),
    Work("wang2008rotation", ("Wenping Wang", "Bert Jüttler", "Dayue Zheng", "Yang Liu"),
         "Computation of Rotation Minimizing Frames", _TOG, 2008, "frames along limbs", "27", "1", "10.1145/1330511.1330513"),
    Work("stava2014inverse", ("Ondřej Šťava", "Sören Pirk", "Julian Kratt", "Baoquan Chen", "Radomír Měch", "Oliver Deussen", "Bedřich Beneš"),
         "Inverse Procedural Modelling of Trees", _CGF, 2014,
         "the similarity of two trees, after which our S_T is made", "33", "6", "10.1111/cgf.12282", of=MEASURES),
    Work("zhang1996constrained", ("Kaizhong Zhang",),
         "A Constrained Edit Distance Between Unordered Labeled Trees", "Algorithmica", 1996,
         "the third of S_T that compares structure", "15", "3", "10.1007/BF01975866", of=MEASURES),
    Work("du2019adtree", ("Shenglan Du", "Roderik Lindenbergh", "Hugo Ledoux", "Jantien Stoter", "Liangliang Nan"),
         "AdTree: Accurate, Detailed, and Automatic Modelling of Laser-Scanned Trees", "Remote Sensing", 2019,
         "what trees of scans are held against", "11", "18", "10.3390/rs11182074", of=MEASURES),
    Work("raumonen2013fast", ("Pasi Raumonen", "Mikko Kaasalainen", "Markku Åkerblom", "Sanna Kaasalainen", "Harri Kaartinen", "Mikko Vastaranta", "Markus Holopainen", "Mathias Disney", "Philip Lewis"),
         "Fast Automatic Precision Tree Models from Terrestrial Laser Scanner Data", "Remote Sensing", 2013,
         "TreeQSM, whose cylinders say how thick and how long wood is", "5", "2", "10.3390/rs5020491", of=MEASURES),
    Work("hackenberg2015simpletree", ("Jan Hackenberg", "Heinrich Spiecker", "Kim Calders", "Mathias Disney", "Pasi Raumonen"),
         "SimpleTree - An Efficient Open Source Tool to Build Tree Models from TLS Clouds", "Forests", 2015,
         "SimpleForest's forerunner, whose cylinders say the same", "6", "11", "10.3390/f6114245", of=MEASURES),
)  # fmt: skip
"""Works in the order of what they matter to a result."""
