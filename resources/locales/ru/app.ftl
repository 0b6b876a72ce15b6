# Окно.
app-name = Sinew
app-title-more = { $file } и ещё { $count }
app-about = Клипы скелетной анимации и мышцы постоянного объёма в одной сцене. Рисует без видеокарты.
app-no-display = Нет экрана, на котором можно открыть окно. Картинку можно получить и без него: sinew render ФАЙЛ -o picture.png
app-no-fonts = На этой машине нет ни одного шрифта, и окно не могло бы ничего сказать: установите какой-нибудь, например DejaVu (в Debian – пакет fonts-dejavu-core).
app-open = Открыть
app-cancel = Отмена
app-save = Сохранить
app-retry = Повторить
app-details = Подробности
app-bar-close = Убрать эту строку
app-copied = Скопировано.
app-warning = Предупреждение
app-note = Примечание
app-line = строка { $line }
app-at-line = Строка { $line }
app-at-line-column = Строка { $line }, столбец { $column }
app-unit-mm = мм
app-unit-cm = см
app-unit-m = м
app-unit-s = с
app-unit-cm3 = см³
app-unit-m3 = м³

# Страницы и группы
app-page-muscle = Мышца
app-page-display = Вид
app-page-health = Проверка
app-group-files = Файлы
app-group-pictures = Картинки и экспорт
app-group-playback = Воспроизведение
app-group-time = Время
app-group-camera = Камера и свет
app-group-model = Модель
app-group-display = Вид
app-group-inspection = Осмотр
app-group-window = Окно
app-group-mouse = Мышь
app-menu-camera = Камера
app-menu-display = Вид
app-menu-colours = Оформление
app-file-cameras = Камеры из файла

# Команды
app-do-open = Открыть файлы
app-do-compare-file = Сравнить с файлом…
app-do-reload = Прочитать заново
app-do-previous-file = Предыдущий файл в папке
app-do-next-file = Следующий файл в папке
app-do-picture = Сохранить картинку
app-do-picture-transparent = Сохранить картинку без фона
app-do-copy-picture = Скопировать картинку
app-do-close = Закрыть
app-do-quit = Выйти
app-do-play = Воспроизведение или пауза
app-do-reverse = Воспроизвести назад
app-do-frame-back = На кадр назад
app-do-frame-forward = На кадр вперёд
app-do-second-back = На секунду назад
app-do-second-forward = На секунду вперёд
app-do-first = В начало
app-do-last = В конец
app-do-previous-key = Предыдущий ключ
app-do-next-key = Следующий ключ
app-do-slower = Медленнее
app-do-faster = Быстрее
app-do-normal-speed = Обычная скорость
app-do-loop-mode = По кругу, один раз, туда и обратно
app-do-mark-a = Поставить метку A
app-do-mark-b = Поставить метку B
app-do-clear-marks = Убрать метки A и B
app-do-time-closer = Шкалу времени крупнее
app-do-time-wider = Шкалу времени мельче
app-do-time-whole = Шкала времени целиком
app-do-sheet = Ключи по костям
app-do-curves = Кривые
app-do-previous-clip = Предыдущий клип
app-do-next-clip = Следующий клип
app-do-fit = Показать всё
app-do-reset-camera = Вернуть камеру
app-do-centre = Показать выбранное
app-do-view-front = Спереди
app-do-view-back = Сзади
app-do-view-right = Справа
app-do-view-left = Слева
app-do-view-top = Сверху
app-do-view-bottom = Снизу
app-do-view-iso = Изометрия
app-do-view-iso-opposite = Изометрия сзади
app-do-orthographic = Параллельная проекция
app-do-fly = Полёт
app-do-follow = Следовать за выделенным
app-do-smooth-camera = Плавный переход камеры
app-do-reset-light = Вернуть свет на место
app-do-tool-navigate = Осмотр: мышь двигает камеру
app-do-tool-move = Двигать модель
app-do-tool-rotate = Вращать модель
app-do-tool-scale = Менять размер модели
app-do-reset-model = Вернуть модель на место
app-do-contract-more = Сократить на 5 %
app-do-contract-less = Расслабить на 5 %
app-do-elbow-more = Согнуть локоть на 5°
app-do-elbow-less = Разогнуть локоть на 5°
app-do-undo = Отменить
app-do-redo = Вернуть
app-step = { $what }: { $step } ({ $key })
app-edit-move = сдвиг модели
app-edit-rotate = поворот модели
app-edit-scale = размер модели
app-edit-reset-model = возврат модели на место
app-edit-light = сдвиг света
app-edit-visible = показ или скрытие
app-edit-isolate = только выделенное
app-edit-turn-by-hand = поворот сустава
app-edit-reset-turns = сброс поворотов рукой
app-edit-bend = сгибание сустава
app-edit-contract = сокращение мышцы
app-edit-release = возврат сустава клипу
app-edit-joint = выбор сустава
app-edit-on-top = сгибание поверх клипа
app-do-bones = Кости
app-do-bone-names = Названия костей
app-do-bone-axes = Оси костей
app-do-xray = Кости сквозь поверхность
app-do-mesh = Сетки
app-do-muscle = Мышцы
app-do-see-through = Мышцы сквозь кожу
app-do-materials = Материалы и текстуры
app-do-smooth-normals = Сглаженные нормали
app-do-normal-glyphs = Нормали отрезками
app-do-wireframe = Рёбра
app-do-weights = Веса выбранной кости
app-do-ghosts = Соседние моменты
app-do-bone-path = Путь выделенного
app-do-compare-skinning = Обе привязки рядом
app-do-stop-comparing = Закончить сравнение
app-do-isolate = Только выделенное
app-do-hide = Скрыть выделенное
app-do-show-all = Показать всё
app-do-grid = Сетка пола
app-do-axes = Оси мира
app-do-bounding-box = Габариты
app-do-depth-test = Проверка глубины
app-do-cull-back-faces = Без обратных сторон
app-do-smooth-edges = Сглаживание краёв
app-do-preset-clean = Набор «Чисто»
app-do-preset-skeleton = Набор «Скелет»
app-do-preset-inspection = Набор «Осмотр»
app-do-preset-print = Набор «Для печати»
app-do-flat = Плоское
app-do-gouraud = По Гуро
app-do-phong = По Фонгу
app-do-sidebars = Обе боковые панели
app-do-tree = Дерево сцены
app-do-panel = Правая панель
app-do-fullscreen = Во весь экран
app-do-frame-times = Время кадра
app-do-colours-system = Как в системе
app-do-colours-light = Светлое
app-do-colours-dark = Тёмное
app-do-menu = Главное меню
app-do-help = Справка
app-do-shortcuts = Сочетания клавиш
app-do-about = О программе

# Мышь
app-mouse-orbit = Облёт
app-mouse-orbit-how = Левая или средняя кнопка
app-mouse-pan = Сдвиг
app-mouse-pan-how = Shift и левая кнопка
app-mouse-zoom = Приближение
app-mouse-zoom-how = Колесо, щипок или Ctrl и левая кнопка
app-mouse-zoom-pointer = Приближение к указателю
app-mouse-zoom-pointer-how = Ctrl и колесо
app-mouse-light = Свет
app-mouse-light-how = Правая кнопка; Shift и правая кнопка возвращают его
app-mouse-pick = Выбор
app-mouse-pick-how = Щелчок
app-mouse-centre = В центр
app-mouse-centre-how = Двойной щелчок
app-mouse-fly = В полёте
app-mouse-fly-how = W A S D Q E, Shift быстрее, Alt медленнее, колесо задаёт скорость, Esc завершает
app-mouse-time = На шкале времени
app-mouse-time-how = Shift и мышь – метки A и B, колесо – по кадрам, Ctrl и колесо – крупнее, Shift и колесо – сдвиг

# Картинка
app-nothing-drawn = Рисовать в этом файле нечего – см. «Проверка».
app-viewport = Сцена
app-hint = Мышь вращает · Shift сдвигает · колесо –⁠ масштаб · правая кнопка –⁠ свет
app-hint-move = Тяните ось, квадрат или где угодно · Ctrl –⁠ по шагам · средняя кнопка –⁠ вид · V –⁠ обратно
app-hint-rotate = Тяните кольцо или где угодно · Ctrl –⁠ по 15° · средняя кнопка вращает вид · V –⁠ обратно
app-hint-scale = Тяните кубик или вверх · Ctrl –⁠ по шагам · средняя кнопка вращает вид · V –⁠ обратно
app-hint-fly = W A S D и Q E –⁠ полёт · мышь –⁠ взгляд · колесо –⁠ { $speed } м/с · Esc завершает
app-times = { $rate } кадр/с · { $total } мс
    поза { $pose } · вершины { $vertex }
    растр { $raster } · сведение { $resolve }
app-axis-x = X
app-axis-y = Y
app-axis-z = Z
app-numbers-move = Сдвиг, м
app-numbers-rotate = Поворот, °
app-numbers-scale = Размер
app-drop-here = Отпустите, чтобы открыть
app-open-folder = Открыть папку
app-folder-failed = Папку не показать: { $reason }
app-weights-of = Веса: { $name }
app-status-memory = { $size } МБ
app-status-position = { $name }: x { $x }; y { $y }; z { $z } м
app-status-triangles = { $count ->
    [one] { $shown } треугольник
    [few] { $shown } треугольника
   *[other] { $shown } треугольников
}
app-picture-title = Сохранить картинку
app-picture-copied = Картинка скопирована.
app-saved = Сохранено: { $file }.
app-unsaved = Не удалось сохранить { $file }

# Файлы
app-loading = Чтение: { $file } …
app-loading-progress = Чтение
app-refused = Не удалось открыть { $file }
app-kept = То, что было открыто, осталось.
app-reader-broke = Этот файл не удалось прочитать из-за ошибки в программе. Пожалуйста, сообщите о ней и приложите файл.
app-reloaded = Прочитано заново: ничего не изменилось.
app-reloaded-changes = Прочитано заново: { $changes }.
app-compared-lost = Файл { $file }, с которым сравнивает сеанс, не открывается.
app-compared-again = { $file }: { $news }
app-changed-gone = пропало: { $names }
app-changed-new = новое: { $names }
app-changed-clips-gone = пропали клипы: { $names }
app-changed-clips-new = новые клипы: { $names }
app-changed-more = { $names } и ещё { $count }
app-changed-triangles = треугольников { $old } → { $new }
app-changed-seconds = секунд { $old } → { $new }
app-changed-findings = замечаний { $old } → { $new }
app-changed-shapes = изменилась форма сеток: { $count }
app-changed-curves = изменились ключи каналов: { $count }
app-findings = { $count ->
    [one] При чтении найдена { $count } странность – см. «Проверка».
    [few] При чтении найдены { $count } странности – см. «Проверка».
   *[other] При чтении найдено { $count } странностей – см. «Проверка».
}
app-choose-compared = Сравнить с файлом
app-choose-title = Открыть файлы
app-choose-open = Открыть
app-choose-ours = Клипы и мышцы
app-choose-all = Все файлы
app-recent = Недавние файлы
app-recent-none = Пока нет
app-settings-broken = Настройки в { $file } не читаются и пропущены: { $reason }
app-settings-unsaved = Не удалось сохранить настройки: { $reason }
app-missing = нет: { $what }
app-missing-still = нет: { $what } – двигаться нечему
app-missing-mesh = сетка
app-missing-skeleton = скелет
app-missing-animation = анимация

# Начальная страница
app-start-title = Ничего не открыто
app-start-text = Откройте клип COLLADA (.dae, .zae) или мышцу (.yaml) либо перетащите файлы сюда.
app-start-open = Открыть файлы
app-start-more = Открыть что-нибудь другое
app-start-back = Назад к сцене
app-start-demos = Примеры
app-demo-biceps = Измеренный бицепс
app-demo-curl = Бицепс и трицепс на сгибаемой руке
app-demo-atlas = Мышцы в стеклянной руке
app-demo-walker = Шагающий робот
app-demo-lamp = Качающаяся лампа
app-demo-unwritten = Не удалось записать примеры в { $folder }
app-do-save-session = Сохранить сеанс как…
app-do-start-page = Начальная страница
app-session-title = Сохранить сеанс
app-session-saved = Сеанс сохранён в { $file }

# Шкала времени
app-play = Воспроизвести
app-time = Время
app-time-tip = Время в секундах
app-clip = Клип
app-speed = Скорость; меньше 0 – назад
app-seconds = Время
app-seconds-tip = Точное время в секундах
app-frame = Кадр
app-frame-tip = Номер кадра
app-no-animation = Анимации нет
app-loop = по кругу
app-once = один раз
app-ping-pong = туда и обратно
app-loop-tip = В конце: { $mode } ({ $key })
app-rate = { $rate } к/с
app-rate-own = Авто: { $rate } к/с
app-rate-tip = Кадров в секунду для номеров кадров
app-sheet-none = Здесь ничего не анимировано
app-sheet-row = Чьи кривые показаны
app-sheet-graph = Какие кривые показаны
app-sheet-values = { $time }:   { $values }
app-graph-translation = Положение
app-graph-rotation = Поворот, °
app-graph-scale = Масштаб
app-graph-other = Прочие числа
app-graph-weights = Веса морфинга
app-graph-colour = Цвет
app-graph-shininess = Блеск
app-graph-opacity = Непрозрачность

# Дерево сцены
app-tree = Дерево сцены
app-search = Найти узел
app-tree-nothing = Ничего не открыто.
app-search-nothing = Ничего не найдено.
app-hide-node = Показать или скрыть

# Мышца
app-contraction = Сокращение
app-contraction-tip = Сокращение в процентах; угол в локте меняется вместе с ним
app-elbow = Угол в локте
app-elbow-tip = Угол в локте в градусах; сокращение меняется вместе с ним
app-elbow-clip-tip = Сгибает этот сустав вручную, в градусах – вместо клипа или поверх него
app-joint = Сустав
app-joint-tip = Какой сустав сгибает ползунок
app-joint-found = { $name } (найден)
app-joint-angle = Угол
app-joint-axis = Ось
app-joint-axis-hinge = сгиб
app-joint-on-top = Поверх клипа
app-joint-on-top-tip = Включено: добавляется к тому, что делает с суставом клип. Выключено: у сустава именно этот угол, что бы ни делал клип.
app-joint-release = Отпустить
app-held-elbow = Локоть удерживается на { $angle }
app-held-joint = «{ $joint }» удерживается на { $angle }
app-joint-release-tip = Вернуть сустав клипу
app-new-muscle = Новая
app-new-muscle-tip = Добавить мышцу: на руку или на кости, которые сходятся в выбранном суставе либо в локте
app-muscle-menu = Копия, удаление, замена готовой мышцей
app-do-new-muscle = Добавить мышцу
app-do-duplicate-muscle = Создать копию
app-do-delete-muscle = Удалить
app-do-pick-origin = Указать кость начала
app-do-pick-insertion = Указать кость прикрепления
app-muscle-replace = Поставить на её место
app-muscle-name = Название
app-fit-length = Принять нынешнюю длину
app-fit-length-tip = В покое мышца будет такой длины, какая сейчас между её концами
app-ends-heading = Концы
app-ends-none = нет
app-origin = Начало
app-origin-bone = Кость начала
app-origin-pick = Указать кость начала
app-origin-x = Начало: смещение вдоль оси X кости
app-origin-y = Начало: смещение вдоль оси Y кости
app-origin-z = Начало: смещение вдоль оси Z кости
app-insertion = Прикрепление
app-insertion-bone = Кость прикрепления
app-insertion-pick = Указать кость прикрепления
app-insertion-x = Прикрепление: смещение вдоль оси X кости
app-insertion-y = Прикрепление: смещение вдоль оси Y кости
app-insertion-z = Прикрепление: смещение вдоль оси Z кости
app-via = Промежуточные точки
app-via-unit = Промежуточные точки, { $unit }
app-via-number = Промежуточная точка { $number }
app-via-short = { $number }.
app-via-bone = Кость промежуточной точки { $number }
app-via-pick = Указать место промежуточной точки { $number }
app-via-delete = Удалить промежуточную точку { $number }
app-via-up = Проходить промежуточную точку { $number } раньше, ближе к началу
app-via-down = Проходить промежуточную точку { $number } позже, ближе к прикреплению
app-via-x = Промежуточная точка { $number }: смещение вдоль оси X кости
app-via-y = Промежуточная точка { $number }: смещение вдоль оси Y кости
app-via-z = Промежуточная точка { $number }: смещение вдоль оси Z кости
app-via-add = Добавить точку
app-via-add-tip = Новая точка посередине самого длинного отрезка; её можно перетащить на картинке
app-via-pick-new = Указать место новой промежуточной точки
app-wrap = Огибание сустава
app-wrap-on = Шар на
app-wrap-bone = Кость, несущая шар, который огибает мышца; шар ставится в её сустав
app-wrap-pick = Указать кость, сустав которой огибает мышца
app-wrap-centre = Центр шара
app-wrap-centre-short = Центр
app-wrap-x = Центр шара: смещение вдоль оси X кости
app-wrap-y = Центр шара: смещение вдоль оси Y кости
app-wrap-z = Центр шара: смещение вдоль оси Z кости
app-wrap-radius = Радиус шара
app-wrap-radius-short = Радиус
app-wrap-side = Сторона
app-wrap-side-x = Сторона, с которой проходит мышца: доля вдоль оси X кости
app-wrap-side-y = Сторона, с которой проходит мышца: доля вдоль оси Y кости
app-wrap-side-z = Сторона, с которой проходит мышца: доля вдоль оси Z кости
app-wrap-flip = Огибать шар с другой стороны
app-hint-pick-origin = Щёлкните кость, от которой идёт мышца, – здесь или в дереве · Esc –⁠ выйти
app-hint-pick-insertion = Щёлкните кость, к которой идёт мышца, – здесь или в дереве · Esc –⁠ выйти
app-hint-pick-via = Щёлкните здесь место на кости, через которое проходит мышца, или кость в дереве · Esc –⁠ выйти
app-hint-pick-wrap = Щёлкните кость, сустав которой огибает мышца, – здесь или в дереве · Esc –⁠ выйти
app-which-muscle = Мышца
app-no-muscle = В этой сцене нет мышц. Добавьте мышцу кнопкой «Новая» или откройте файл мышцы (.yaml).
app-held = При такой длине мышца не может сохранить объём. Длина удержана на пределе.
app-alone = Мышца ни к чему не прикреплена. Задайте ниже начало и прикрепление.
app-alone-twisted = «{ $joint }» поворачивается вокруг самой кости, и мышце не через что перекинуться, поэтому она ни к чему не прикреплена. Выберите другую ось сустава и добавьте мышцу снова либо задайте ниже начало и прикрепление.
app-on-own-arm = Эти мышцы – на собственной руке, рядом с клипом.
app-hang = Прикрепить к «{ $joint }» клипа
app-hang-tip = Перенести мышцы этого файла на кости, сходящиеся в этом суставе; длина и толщина – по размеру костей. Чтобы взять другой сустав, выделите другую кость. «Отменить» вернёт мышцы на их руку.
app-hung = { $count ->
    [one] { $count } мышца теперь на «{ $joint }». «Отменить» вернёт её на руку.
    [few] { $count } мышцы теперь на «{ $joint }». «Отменить» вернёт их на руку.
   *[other] { $count } мышц теперь на «{ $joint }». «Отменить» вернёт их на руку.
}
app-profile = Профиль
app-profile-tip = Мышца сбоку: сейчас (красная) и в покое (пунктир). Потяните за точку, чтобы изменить радиус, с Shift – рост.
app-profile-legend = красное – сейчас · пунктир – в покое
app-profile-node = узел { $node }: { $now } (в покое { $rest })
app-volume-heading = Длина и объём
app-length = Длина L
app-rest-length = Длина покоя L₀
app-shortening = Изменение длины
app-volume = Объём V
app-rest-volume = Объём покоя V₀
app-volume-error = Ошибка V / V₀ − 1
app-delta = Шаг роста δ
app-quadratic-heading = Почему утолщается: A δ² + B δ + C = 0
app-a = A
app-b = B
app-c = C
app-discriminant = B² − 4AC
app-root-taken = Взятый корень
app-root-other = Другой корень
app-nodes-heading = Узлы
app-node-number = Узел
app-node-rest = Покой, { $unit }
app-node-growth = Рост
app-node-now = Сейчас, { $unit }
app-ledger-arm = Плечо силы
app-ledger-thickest = Наибольший радиус
app-ledger-thickest-value = { $radius } (узел { $node })
app-limits = Длина может быть от { $short } ({ $short_cause }) до { $long } ({ $long_cause }).
app-limit-discriminant = там B² − 4AC равно 0
app-limit-radius = там радиус узла { $node } равен 0
app-limit-shortest = короче 40 % длины в покое брюшко не становится
app-limit-reach = дальше программа не идёт
app-root-larger = Взят корень, который стремится к 0, когда L стремится к L₀: больший, потому что B не отрицательно.
app-root-smaller = Взят корень, который стремится к 0, когда L стремится к L₀: меньший, потому что B отрицательно.
app-root-double = Корни совпадают: длина на пределе.
app-node-radius = Радиус в покое
app-node-radius-tip = Радиус узла { $number } в покое; Enter – применить
app-node-growth-tip = Насколько узел { $number } растёт по сравнению с другими; Enter – применить
app-node-add = Добавить узел
app-node-add-tip = Новый узел за выбранным; длина не меняется
app-node-delete = Удалить узел
app-node-delete-number = Удалить узел { $node }
app-node-delete-tip = Убирает выбранный узел; длина не меняется
app-shape-heading = Длина, сухожилия, цвет
app-tendon-origin-length = Сухожилие у начала: длина
app-tendon-origin-radius = Сухожилие у начала: радиус
app-tendon-insertion-length = Сухожилие у прикрепления: длина
app-tendon-insertion-radius = Сухожилие у прикрепления: радиус
app-muscle-colour = Цвет
app-do-save = Сохранить мышцу
app-do-save-as = Сохранить мышцу как…
app-do-revert = Вернуть сохранённое
app-save-title = Сохранить мышцу
app-saved-without-comments = Сохранено: { $file }. Комментарии файла сохранить не удалось.
app-ask-save = Сохранить изменения мышцы?
app-ask-save-why = Без сохранения они пропадут.
app-edit-carried = Возврат несохранённых изменений
app-recovery = Программа закрылась раньше, чем были сохранены изменения мышц ({ $what }). Они не потеряны.
app-recovery-restore = Восстановить
app-recovery-discard = Удалить
app-recovery-unwritten = Несохранённые изменения не удаётся уберечь на случай сбоя: { $reason }
app-ask-which = Файл мышцы изменила другая программа, а здесь есть несохранённые изменения.
app-ask-which-why = Оставить свои изменения (по-прежнему несохранёнными) или прочитать файл заново и потерять их?
app-ask-theirs = Прочитать файл
app-ask-mine = Оставить мои
app-ask-discard = Не сохранять

# Вид
app-display-surfaces = Поверхности
app-display-bones = Кости
app-display-space = Пространство
app-display-light = Свет
app-display-drawing = Рисование
app-display-presets = Наборы
app-preset-clean = Чисто
app-preset-skeleton = Скелет
app-preset-inspection = Осмотр
app-preset-print = Печать
app-grid-cell = Клетка пола
app-grid-auto = По размеру
app-backdrop = Фон
app-backdrop-theme = Как окно
app-backdrop-white = Белый
app-backdrop-grey = Серый
app-backdrop-black = Чёрный
app-line-width = Линии
app-light-yaw = Направление света, °
app-light-pitch = Высота света, °
app-tip-see-through = Кожа, под которой есть мышцы, рисуется прозрачной
app-tip-materials = Цвета, текстуры и блеск из файла; выключено – всё одного тона
app-tip-smooth-normals = Свет ложится по нормалям файла, и треугольников не видно
app-tip-normal-glyphs = Короткий отрезок из каждой точки вдоль её нормали
app-tip-wireframe = Рёбра всех треугольников
app-tip-bone-axes = Собственные оси X, Y и Z каждой кости
app-tip-xray = Кости рисуются поверх того, что их заслоняет
app-tip-weights = Насколько сильно выбранная кость движет каждую точку кожи
app-tip-bounding-box = Наименьшая коробка вдоль осей, вмещающая всё
app-tip-smooth-edges = Четыре отсчёта на пиксель: края без ступенек, но рисовать дольше
app-tip-depth-test = Выключено – нарисованное позже закрывает то, что ближе
app-tip-cull-back-faces = Рисуются только треугольники, повёрнутые к камере
app-tip-frame-times = Миллисекунды каждого шага рисования поверх картинки
app-tip-ghosts = Модель за несколько кадров до и после, бледно
app-tip-bone-path = Линия, по которой выделенное движется в этом клипе
app-tip-compare-skinning = Линейная привязка и бикватернионы на одной картинке
app-tip-shading = Плоское – один тон на треугольник. По Гуро – свет считается в вершинах. По Фонгу – в каждом пикселе.
app-tip-skinning = Как кости несут кожу: линейная привязка, как в COLLADA, сужается на скрученных суставах, бикватернионы – нет
app-tip-grid-cell = Сторона клетки на полу
app-tip-line-width = Толщина костей, рёбер, сетки пола и других линий
app-tip-ambient = Свет со всех сторон, чтобы ничто не было чёрным
app-shading = Освещение
app-skinning = Привязка к костям
app-skinning-linear = Линейная
app-skinning-dual = Бикватернионы
app-ghosts = Калька
app-ghosts-before = До
app-ghosts-after = После
app-ghosts-step = Шаг, кадров
app-compare = Сравнение
app-compare-with = С чем сравнить
app-compare-file = Файл…
app-compare-nothing = Ни с чем
app-compare-clip = Клип { $name }
app-compare-skinning = Другая привязка
app-compare-aside = В сторону, м
app-compare-later = Вперёд по времени, с
app-compare-nothing-common = Нет суставов с одинаковыми именами
app-compare-joint = Наибольшее расхождение суставов: { $distance } м ({ $name })
app-compare-vertex = Наибольшее расхождение вершин: { $distance } м
app-compare-ahead = { $name }, на { $seconds } с вперёд
app-ambient = Рассеянный
app-light-default = Вместе с камерой, слева сверху. Правая кнопка мыши на картинке двигает свет.
app-light-position = Положение: x { $x }; y { $y }; z { $z } м

# Проверка
app-health-none = Ничего необычного не найдено.
app-health-warnings = { $count ->
    [one] { $count } предупреждение
    [few] { $count } предупреждения
   *[other] { $count } предупреждений
}
app-health-notes = { $count ->
    [one] { $count } примечание
    [few] { $count } примечания
   *[other] { $count } примечаний
}
app-health-copy = Скопировать как текст
app-facts-collada = COLLADA { $version }, { $axis }, единица { $unit } м
app-facts-muscles = { $count ->
    [one] { $count } мышца
    [few] { $count } мышцы
   *[other] { $count } мышц
}
app-facts-nodes = { $nodes ->
        [one] { $nodes } узел
        [few] { $nodes } узла
       *[other] { $nodes } узлов
    }, { $meshes ->
        [one] { $meshes } сетка
        [few] { $meshes } сетки
       *[other] { $meshes } сеток
    }, { $clips ->
        [one] { $clips } клип
        [few] { $clips } клипа
       *[other] { $clips } клипов
    }

# Замеры
app-page-measure = Замеры
app-measure-none = Измерять нечего: в этой сцене нет мышцы, которая сгибает локоть.
app-measure-hint = Щелчок по графику сгибает локоть до этого угла.
app-measure-angle = Угол в локте, °
app-measure-length = Длина, { $unit }
app-measure-arm = Плечо силы, { $unit }
app-measure-radius = Наибольший радиус, { $unit }
app-measure-copy = Копировать CSV
app-measure-save = Сохранить…
app-measure-save-title = Сохранить как .csv, .png или .svg
app-measure-against = По оси
app-measure-axis-angle = угол в локте
app-measure-axis-time = время клипа
app-measure-time = Время, с
app-measure-hint-time = Щелчок по графику переходит к этому моменту.
app-measure-section = Наибольшее сечение, { $unit }²
app-measure-error = Ошибка объёма V / V₀ − 1
app-measure-published = Опубликованные плечи силы бицепса

# Экспорт.
app-do-export = Экспорт…
app-export-title = Экспорт
app-export-go = Экспортировать…
app-export-kind = Файл
app-export-picture = Картинка (PNG)
app-export-gif = Фильм (GIF)
app-export-apng = Фильм, каждый пиксель как нарисован (APNG)
app-export-pictures = Нумерованные картинки (PNG)
app-export-mp4 = Фильм (MP4, через ffmpeg)
app-export-webm = Фильм (WebM, через ffmpeg)
app-export-obj = Поверхность в этой позе с материалами (OBJ)
app-export-ply = Поверхность в этой позе (PLY)
app-export-stl = Поверхность для печати (STL)
app-export-glb = Вся сцена (glTF, .glb)
app-export-gltf = Вся сцена (glTF, .gltf)
app-export-muscles-csv = Мышцы в числах (CSV)
app-export-muscles-json = Мышцы в числах (JSON)
app-export-joints-csv = Углы суставов по ходу клипа (CSV)
app-export-joints-json = Углы суставов по ходу клипа (JSON)
app-export-joints = Для каждого сустава: сгибание и поворот от позы покоя, по всему клипу
app-export-muscles = Для каждой мышцы: длина, плечо силы, объём, радиусы, по градусам
app-export-muscles-clip = Для каждой мышцы: длина, плечо силы, объём, радиусы, по всему клипу
app-export-losses = Чего glTF не сохранит из этой сцены:
app-export-muscles-png = Мышцы графиком (PNG)
app-export-muscles-svg = Мышцы графиком (SVG)
app-export-joints-png = Углы суставов графиком (PNG)
app-export-joints-svg = Углы суставов графиком (SVG)
app-export-size = Размер, пиксели
app-export-width = Ширина, пиксели
app-export-height = Высота, пиксели
app-export-course = Что движется
app-export-whole = Весь клип или одно сгибание руки
app-export-marks = Клип между A и B
app-export-elbow = Сгибается локоть
app-export-contraction = Сокращается мышца
app-export-turntable = Модель делает оборот
app-export-sweep = От – до
app-export-from = От
app-export-to = До
app-export-duration = Секунды
app-export-fps = Кадров в секунду
app-export-helps = Кости, сетка и прочее, как на экране
app-export-transparent = Без фона
app-export-progress = Ход работы
app-export-frames = { NUMBER($count, useGrouping: 0) } { $count ->
        [one] кадр
        [few] кадра
       *[other] кадров
    } по { $width } × { $height } пикселей, { $seconds } с
app-export-one = Одна картинка { $width } × { $height } пикселей
app-export-surface = Поверхность, как она стоит сейчас: мировые координаты, метры, ось Y вверх
app-export-scene = Узлы, привязки, клипы, материалы; мышцы вздуваются в любой программе
app-export-gif-fps = GIF показывает не больше { $limit } кадров в секунду.
app-ask-replace = «{ $file }» уже есть{ $more ->
        [0] {""}
        [one] , и ещё { NUMBER($more, useGrouping: 0) } файл
        [few] , и ещё { NUMBER($more, useGrouping: 0) } файла
       *[other] , и ещё { NUMBER($more, useGrouping: 0) } файлов
    }. Заменить?
app-ask-replace-why = Об этом имени окно выбора файла не спрашивало.
app-replace = Заменить
app-export-broke = Внутри Sinew что-то пошло не так; ничего не записано.
app-export-empty = Между этими моментами ничего нет.
app-export-too-many = Получится больше { NUMBER($limit, useGrouping: 0) } кадров; возьмите меньше кадров в секунду или отрезок короче.
app-export-no-elbow = Здесь нет локтя, который мог бы согнуться.
app-export-no-muscle = Здесь нет мышцы, которую можно сократить.
# Инспектор
app-space-tip = В чьих осях эти числа
app-space-local = Локально
app-space-world = Мир
app-space-bind = Привязка
app-space-inverse-bind = Обратная
app-inspect-copy = Скопировать матрицы как текст
app-position = Место, м
app-rotation = Поворот, °
app-scale = Масштаб
app-transform = Преобразование
app-matrix = Матрица
app-hand = Повернуть рукой
app-hand-reset = Сбросить
app-hand-reset-tip = Убрать повороты этого сустава
app-hand-reset-all = Сбросить все
app-hand-reset-all-tip = Убрать повороты всех суставов
app-hand-dual = Дуальные кватернионы
app-hand-dual-tip = Смешивать дуальные кватернионы, а не матрицы: скрученный сустав сохраняет объём
app-turn-x = Поворот вокруг X, градусы
app-turn-y = Поворот вокруг Y, градусы
app-turn-z = Поворот вокруг Z, градусы
app-angle = Угол сустава
app-angle-end = У конца цепочки нет своего угла. Выберите три кости.
app-angle-choose = Выбрать три кости
app-angle-from = От
app-angle-corner = В
app-angle-to = До
app-angle-own = Кости выделенного
app-angle-value = { $from } – { $corner } – { $to }: { $angle }
app-angle-across = Время, с
app-angle-up = Угол, °
app-mesh-heading = Сетка
app-mesh-points = Точек: { $points }, вершин: { $vertices }
app-mesh-triangles = Треугольников: { $triangles }, наборов текстурных координат: { $sets }
app-mesh-skin = Скин: суставов – { $joints }, весов – { $influences }, на точку не больше { $most }
app-mesh-morph = Морфинг: целей – { $targets }
app-material-texture = { $name } · { $image }
app-material-lost = { $name } · { $image } не найден
app-vertex = Почему точка { $number } здесь
app-vertex-bind = (форма привязки)
app-vertex-sum = Сумма
app-vertex-note = Кость, вес и вес × место, куда точку поставила бы одна эта кость (x, y, z, м). Сумма и есть точка на экране.
app-vertex-apart = Кость, вес и вес × место, куда точку поставила бы одна эта кость. Дуальные кватернионы рисуют её в { $apart } м от этой суммы.
app-vertex-rigid = Скина у этой точки нет: она движется со своим узлом.
app-distance = Между двумя последними щелчками: { $distance } м
app-distance-one = Щёлкните вторую точку, чтобы измерить расстояние.

app-measure-experiment = Опыт…
app-measure-experiment-tip = Мышца рядом с измеренными радиусами и почему они расходятся
app-experiment = Модель рядом с измерением
app-experiment-title = { $muscle } рядом с { $file }
app-experiment-about = Модель сохраняет объём. Последняя строка показывает объём, который следует из измеренных радиусов при длине мышцы под этим углом.
app-experiment-radii = Радиусы, { $unit }
app-experiment-open = Измеренные радиусы…
app-experiment-fit = Подобрать рост
app-experiment-poses = Взять измеренные позы
app-experiment-unread = Таблица не прочитана
app-do-fit-radii = Подгонка под измеренные радиусы

app-help-title = Справка
app-help-open = Открыть
app-help-open-text = Откройте клип COLLADA (.dae, .zae) или мышцу (.yaml): { $open } – или перетащите файлы на окно; клип и мышца вместе станут одной сценой. Файл, который записали заново, перечитывается сам. { $start-page } – примеры и недавние файлы.
app-help-look = Осмотреться
app-help-look-text = Мышь вращает, с Shift сдвигает, колесо меняет масштаб, правая кнопка двигает свет. { $fit } показывает всё целиком; { $view-front }, { $view-right } и { $view-top } – виды вдоль осей; { $fly } – полёт клавишами W A S D, из него выводит Esc. С { $tool-move }, { $tool-rotate } и { $tool-scale } мышь двигает, поворачивает и масштабирует саму модель, { $tool-navigate } возвращает её к камере.
app-help-time = Проиграть
app-help-time-text = { $play } – проиграть. Щелчок или протягивание по шкале времени переводит к этому моменту, { $frame-back } и { $frame-forward } – на кадр назад и вперёд, { $previous-key } и { $next-key } – к соседнему ключу. { $mark-a } и { $mark-b } ограничивают отрезок. { $sheet } раскрывает ключи по костям, { $curves } – кривые; { $time-closer } показывает всё это крупнее. С { $follow } камера следует за выделенным.
app-help-inside = Заглянуть внутрь
app-help-inside-text = Щелчок выделяет – на картинке и в дереве. Под деревом видно, где стоит выделенное, что в его сетке и, после щелчка по скину, какие кости держат эту точку. { $bones } показывает кости, { $weights } – веса выбранной, { $ghosts } – соседние моменты.
app-help-muscle = Мышцы
app-help-muscle-text = Двигайте «Сокращение» или «Угол локтя» на странице «Мышца»: второе следует за первым, потому что объём сохраняется. Тяните профиль или вводите радиусы, чтобы изменить мышцу; { $undo } отменяет шаг, { $save } сохраняет. Страница «Замеры» строит графики длины и плеча силы.
app-help-keep = Унести с собой
app-help-keep-text = { $picture } сохраняет картинку, { $copy-picture } копирует, { $export } сохраняет фильмы, поверхности и таблицы. { $save-session } сохраняет, что открыто и как на это смотрят.
app-help-trouble = Если что-то не так
app-help-trouble-text = Страница «Проверка» перечисляет всё странное в файле: строку и что с ней сделано. Файл, который не открылся, назван в полосе над картинкой, а открытое остаётся. { $shortcuts } – все сочетания клавиш; в терминале есть sinew --help.
